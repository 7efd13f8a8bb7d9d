#include "extraction/thesis/thesis_extraction.h"

#include "device_commands/commands.h"
#include "extraction/common/extraction_result.h"
#include "extraction/thesis/thesis_pipeline.h"

namespace medial_vk {
namespace {

struct Tests {
  std::uint64_t nodes = 0, triangles = 0;
};

/// Tests by walks for one query and of packets together.
Tests tests_at(const std::uint32_t* words) {
  const auto sum = [&](int i) {
    const auto number = [&](int low) { return words[low] + (std::uint64_t{words[low + 1]} << 32); };
    return number(i) + number(i + 4);
  };
  return {sum(0), sum(2)};
}

void add_counters(const std::array<std::uint32_t, gpu::kCounterCount>& c, const ThesisPipeline& pipeline,
                  ExtractionCounters& sum) {
  Tests before;  // up to the end of the previous level
  for (std::uint32_t level = 0; level < pipeline.level_count(); ++level) {
    const std::uint32_t* counts = &c[gpu::kThesisLevels + gpu::kThesisCountsPerLevel * level];
    sum.levels[level].visited += counts[0];
    sum.levels[level].kept += counts[1];
    sum.queries += std::uint64_t{counts[2]} * pipeline.samples(level);
    const Tests tests = tests_at(counts + gpu::kThesisTests);
    sum.levels[level].node_tests += tests.nodes - before.nodes;
    sum.levels[level].triangle_tests += tests.triangles - before.triangles;
    before = tests;
  }
  sum.levels.back().found += c[gpu::kThesisFound];
  sum.found += c[gpu::kThesisFound];
  sum.undecided += c[gpu::kThesisKept] - c[gpu::kThesisFound];
  sum.queries += c[gpu::kThesisQueries];
}

Status run_chunk(ContextImpl& context, const DeviceMesh& mesh, ThesisPipeline& pipeline, std::uint32_t first,
                 std::uint32_t count, StopWatch& watch, Extraction& extraction) {
  for (std::uint32_t part = 0; part < pipeline.part_count(); ++part) {
    auto times = run_commands(
        context, [&](Recorder& r) { return pipeline.record_part(r, part, first, count); }, [&] { watch.stopped(); });
    if (!times.ok()) return times.error();
    if (watch.stopped()) return StopWatch::error();
    add_times(times.value(), extraction.measurements.device_times);
  }
  const auto counters = pipeline.read_counters();
  auto points = pipeline.read_points(counters[gpu::kThesisFound]);
  if (!points.ok()) return points.error();
  for (const gpu::FoundPoint& point : points.value()) extraction.spheres.push_back(to_input_units(point, mesh));
  add_counters(counters, pipeline, extraction.measurements.counters);
  return {};
}

}  // namespace

Result<Extraction> extract_thesis(ContextImpl& context, DeviceMesh& mesh, const ExtractionOptions& options,
                                  StopWatch& watch) {
  Result<const StopWord*> stop = watch.make_word(context);
  if (!stop.ok()) return stop.error();
  Extraction extraction;
  extraction.grid = make_grid(mesh, options.resolution);
  Result<ThesisPipeline> created = ThesisPipeline::create(context, mesh, options, extraction.grid.size, *stop.value());
  if (!created.ok()) return created.error();
  if (watch.stopped()) return StopWatch::error();
  const auto record_one = [&](Recorder& r) {
    Status status;
    for (std::uint32_t part = 0; part < created.value().part_count() && status.ok(); ++part) {
      status = created.value().record_part(r, part, 0, 1);
    }
    return status;
  };
  if (Status s = make_programs(context, record_one); !s.ok()) return s.error();
  if (Status there = mesh.finish_uploads(); !there.ok()) return there.error();
  ThesisPipeline pipeline = std::move(created).value();
  extraction.measurements.counters.levels.resize(pipeline.level_count());
  for (std::uint32_t level = 0; level < pipeline.level_count(); ++level) {
    extraction.measurements.counters.levels[level].cell_size = pipeline.cell_size(level);
  }
  const std::uint32_t total = pipeline.top_cells();
  for (std::uint32_t first = 0; first < total; first += pipeline.chunk_size()) {
    watch.set_done(static_cast<double>(first) / total);
    if (watch.stopped()) return StopWatch::error();
    const std::uint32_t count = std::min(pipeline.chunk_size(), total - first);
    Status status = run_chunk(context, mesh, pipeline, first, count, watch, extraction);
    if (!status.ok()) return status.error();
  }
  sort_by_voxel(extraction.spheres);
  return extraction;
}

}  // namespace medial_vk
