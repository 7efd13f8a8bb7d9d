// The main job, chunk by chunk: ranges of top cells go through the recorded pipeline; a range that needs more memory
// than there is runs again in halves.
#include "medial_vk/extraction.h"

#include <algorithm>
#include <cmath>

#include "certified_pipeline.h"
#include "check_parameters.h"
#include "context_impl.h"
#include "extraction_result.h"
#include "host_memory.h"
#include "scene.h"
#include "thesis_extraction.h"

namespace medial_vk {
namespace {

void add_counters(const std::array<std::uint32_t, gpu::kCounterCount>& c, ExtractionCounters& sum) {
  for (std::size_t level = 0; level < sum.levels.size(); ++level) {
    const std::uint32_t* s = &c[gpu::kStatistics + gpu::kStatisticsPerLevel * level];
    sum.levels[level].visited += s[gpu::kVisitedCount];
    sum.levels[level].kept += s[gpu::kKeptCount];
    sum.levels[level].contacts += s[gpu::kContactCount];
    sum.levels[level].found += s[gpu::kFoundCount];
    sum.levels[level].lines += s[gpu::kLineCount];
    sum.levels[level].cluster_tests += s[gpu::kClusterTestCount];
    sum.levels[level].triangle_tests += s[gpu::kTestCount] + (std::uint64_t{s[gpu::kTestCount + 1]} << 32);
  }
  sum.found += c[gpu::kFound];
  sum.undecided += c[gpu::kUndecided];
  sum.queries += c[gpu::kQueries];
}

class CertifiedRun {
 public:
  CertifiedRun(Context::Impl& context, const DeviceMesh& mesh, CertifiedPipeline& pipeline, StopWatch& watch,
               Extraction& extraction)
      : context_(context), mesh_(mesh), pipeline_(pipeline), watch_(watch), extraction_(extraction) {}

  Status run() {
    const std::uint32_t total = pipeline_.top_cells();
    std::uint32_t size = std::min({kFirstChunk, pipeline_.likely_chunk(), pipeline_.largest_chunk()});
    for (std::uint32_t first = 0; first < total;) {
      watch_.set_done(double(first) / total);
      if (watch_.stopped()) return StopWatch::error();
      const std::uint32_t count = std::min(size, total - first);
      Result<Fill> fill = run_chunk(first, count);
      if (!fill.ok()) return fill.error();
      if (fill.value().overflow) {
        if (!fill.value().too_few_rounds && count == 1) return too_small();
        ++extraction_.counters.retries;
      } else {
        first += count;
      }
      size = next_size(count, fill.value());
    }
    return {};
  }

 private:
  // Small enough that progress moves and an interruption is heard, large enough to keep a device busy.
  static constexpr std::uint32_t kFirstChunk = 1024, kLargestChunk = 4096;

  // How full the fullest buffer has been: 1 is full.
  struct Fill {
    double share = 0;
    bool overflow = false;
    bool too_few_rounds = false;  // the overflow was none of a buffer
  };

  std::uint32_t next_size(std::uint32_t count, const Fill& fill) const {
    if (fill.too_few_rounds) return count;
    const double factor = std::clamp(pipeline_.aim() / std::max(fill.share, 1e-3), 0.1, fill.overflow ? 0.5 : 2.0);
    return std::clamp(static_cast<std::uint32_t>(count * factor), 1u,
                      std::min(kLargestChunk, pipeline_.largest_chunk()));
  }

  static Error too_small() {
    return {ErrorCode::kOutOfMemory,
            "the contacts of a single top cell do not fit the memory budget; raise --memory or the resolution"};
  }

  Result<Fill> run_chunk(std::uint32_t first, std::uint32_t count) {
    auto times = run_commands(
        context_, [&](Recorder& r) { return pipeline_.record(r, first, count); }, [&] { watch_.stopped(); });
    if (!times.ok()) return times.error();
    if (watch_.stopped()) return StopWatch::error();
    add_times(times.value(), extraction_.device_times);  // chunks that are run again cost time too
    const auto counters = pipeline_.read_counters();
    const std::uint32_t overflow = counters[gpu::kOverflow];
    const Fill fill{counters[gpu::kUtilisation] / 1024.0, overflow != 0, overflow == gpu::kTooFewRounds};
    if (fill.too_few_rounds) pipeline_.add_rounds();
    if (fill.overflow) return fill;
    auto points = pipeline_.read_points(counters[gpu::kFound]);
    if (!points.ok()) return points.error();
    std::vector<MedialSphere>& spheres = extraction_.spheres;
    const std::size_t needed = spheres.size() + points.value().size();
    if (needed > spheres.capacity()) spheres.reserve(std::max(needed, 2 * spheres.capacity()));
    for (const gpu::FoundPoint& p : points.value()) spheres.push_back(to_input_units(p, mesh_));
    auto undecided = pipeline_.read_undecided(counters[gpu::kUndecided]);
    if (!undecided.ok()) return undecided.error();
    for (const gpu::UndecidedCell& u : undecided.value()) extraction_.undecided.push_back(to_input_units(u, mesh_));
    add_counters(counters, extraction_.counters);
    return fill;
  }

  Context::Impl& context_;
  const DeviceMesh& mesh_;
  CertifiedPipeline& pipeline_;
  StopWatch& watch_;
  Extraction& extraction_;
};

Result<Extraction> extract_certified(Context::Impl& context, const MeshView& view, const MeshIndex& index,
                                     const ExtractionParameters& parameters, StopWatch& watch) {
  Result<const StopWord*> stop = watch.make_word(context);
  if (!stop.ok()) return stop.error();
  Result<DeviceMesh> mesh = DeviceMesh::create(context, view, index);
  if (!mesh.ok()) return mesh.error();
  if (watch.stopped()) return StopWatch::error();
  Extraction extraction;
  extraction.grid = make_grid(mesh.value(), parameters.resolution);
  auto pipeline = CertifiedPipeline::create(context, mesh.value(), parameters, extraction.grid.size, *stop.value());
  if (!pipeline.ok()) return pipeline.error();
  extraction.counters.levels.resize(pipeline.value().level_count());
  for (std::uint32_t level = 0; level < pipeline.value().level_count(); ++level)
    extraction.counters.levels[level].cell_size = pipeline.value().cell_size(level);
  const auto record_one = [&](Recorder& r) { return pipeline.value().record(r, 0, 1); };
  if (Status made = make_programs(context, record_one); !made.ok()) return made.error();
  CertifiedRun run(context, mesh.value(), pipeline.value(), watch, extraction);
  if (Status s = run.run(); !s.ok()) return s.error();
  ExtractionCounters& c = extraction.counters;
  c.narrowing_steps = pipeline.value().narrowing_steps();
  const std::size_t finest = c.levels.size() - 1 - parameters.extra_levels;
  c.proved_empty = c.levels[finest].visited - c.found - c.undecided;
  sort_by_voxel(extraction.spheres);
  sort_by_voxel(extraction.undecided);
  return extraction;
}

/// Without an index one is made, where it is needed.
Result<Extraction> extract(Context& context, const MeshView& mesh, const MeshIndex* index,
                           const ExtractionParameters& parameters, const ProgressCallback& progress,
                           const std::stop_token& stop) {
  if (Status s = check_parameters(parameters); !s.ok()) return s.error();
  StopWatch watch(progress, stop);
  Result<Extraction> extraction = catch_out_of_memory("extracting medial spheres", [&]() -> Result<Extraction> {
    if (parameters.mode == Mode::kThesis) return extract_thesis(context.impl(), mesh, parameters, watch);
    if (index != nullptr) return extract_certified(context.impl(), mesh, *index, parameters, watch);
    const VkPhysicalDeviceLimits& limits = context.impl().limits;
    if (Status s = DeviceMesh::check_size(mesh.triangles.size(), limits); !s.ok()) return s.error();
    const Result<MeshIndex> made = MeshIndex::create(mesh);
    if (!made.ok()) return made.error();
    if (watch.stopped()) return StopWatch::error();
    return extract_certified(context.impl(), mesh, made.value(), parameters, watch);
  });
  if (extraction.ok() && progress) progress(1.0);
  return extraction;
}

}  // namespace

Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress,
                                          const std::stop_token& stop) {
  return extract(context, mesh, nullptr, parameters, progress, stop);
}

Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh, const MeshIndex& index,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress,
                                          const std::stop_token& stop) {
  return extract(context, mesh, &index, parameters, progress, stop);
}

}  // namespace medial_vk
