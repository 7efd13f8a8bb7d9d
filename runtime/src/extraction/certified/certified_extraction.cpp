// The certified extraction, chunk by chunk: ranges of top cells run through the recorded pipeline; a range that needs
// more memory than available runs again in halves, and a single top cell in blocks of its voxels.
#include "extraction/certified/certified_extraction.h"

#include <algorithm>
#include <cmath>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_mesh/device_mesh.h"
#include "extraction/certified/certified_pipeline.h"
#include "extraction/common/extraction_result.h"
#include "extraction/common/result_download.h"

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
    const auto in_two_words = [s](std::uint32_t low) { return s[low] + (std::uint64_t{s[low + 1]} << 32); };
    sum.levels[level].triangle_tests += in_two_words(gpu::kTestCount);
    sum.levels[level].node_tests += in_two_words(gpu::kNodeTestCount);
  }
  sum.found += c[gpu::kFound];
  sum.undecided += c[gpu::kUndecided];
  sum.queries += c[gpu::kQueries];
}

class CertifiedRun {
 public:
  CertifiedRun(ContextImpl& context, const DeviceMesh& mesh, CertifiedPipeline& pipeline, std::uint32_t extra_levels,
               StopWatch& watch, Extraction& extraction)
      : mesh_(mesh),
        pipeline_(pipeline),
        extra_levels_(extra_levels),
        watch_(watch),
        extraction_(extraction),
        search_(context),
        collection_(context),
        download_(context) {}
  CertifiedRun(const CertifiedRun&) = delete;
  CertifiedRun& operator=(const CertifiedRun&) = delete;
  /// After an error one part may be pending without the other.
  ~CertifiedRun() {
    for (Commands* part : {&search_, &collection_}) part->drain();
  }

  Status run() {
    const std::uint32_t total = pipeline_.top_cells();
    std::uint32_t size = std::min({kFirstChunk, pipeline_.likely_chunk(), pipeline_.largest_chunk()});
    for (std::uint32_t first = 0; first < total;) {
      watch_.set_done(double(first) / total);
      if (watch_.stopped()) return StopWatch::error();
      const std::uint32_t count = std::min(size, total - first);
      Result<Fill> fill = run_chunk({first, count, {}, extra_levels_});
      if (!fill.ok()) return fill.error();
      size = next_size(count, fill.value());
      if (fill.value().overflow) ++extraction_.measurements.counters.retries;
      if (fill.value().overflow && (count > 1 || fill.value().too_few_rounds)) continue;
      if (fill.value().overflow) {
        if (Status divided = run_in_blocks(first); !divided.ok()) return divided;
      }
      first += count;
    }
    return take_points();
  }

 private:
  // Small enough for frequent progress and a prompt stop, large enough to keep a device busy.
  static constexpr std::uint32_t kFirstChunk = 1024, kLargestChunk = 4096;

  // The greatest fill of a buffer; 1: full.
  struct Fill {
    double share = 0;
    bool overflow = false;
    bool too_few_rounds = false;  // the overflow was not that of a buffer
  };

  std::uint32_t next_size(std::uint32_t count, const Fill& fill) const {
    if (fill.too_few_rounds) return count;
    const double factor = std::clamp(pipeline_.aim() / std::max(fill.share, 1e-3), 0.1, fill.overflow ? 0.5 : 2.0);
    return std::clamp(static_cast<std::uint32_t>(count * factor), 1u,
                      std::min(kLargestChunk, pipeline_.largest_chunk()));
  }

  static Error too_small() {
    return {ErrorCode::kOutOfMemory,
            "the contacts of a single voxel do not fit the device memory; raise `memory_budget` or `resolution`"};
  }

  // The top cell that does not fit: block by block of its voxels. A voxel that does not fit by itself is not divided as
  // often as others.
  Status run_in_blocks(std::uint32_t top_cell) {
    const GridBlock whole = pipeline_.block_of(top_cell);
    std::vector<SearchRange> left;
    divide({top_cell, 1, whole, extra_levels_}, left);
    double done = top_cell;
    while (!left.empty()) {
      watch_.set_done(done / pipeline_.top_cells());
      if (watch_.stopped()) return StopWatch::error();
      SearchRange range = left.back();
      Result<Fill> fill = run_chunk(range);
      if (!fill.ok()) return fill.error();
      if (fill.value().overflow) ++extraction_.measurements.counters.retries;
      if (fill.value().too_few_rounds) continue;
      left.pop_back();
      if (!fill.value().overflow) {
        done += std::ldexp(1, 3 * (static_cast<int>(range.block.shift) - static_cast<int>(whole.shift)));
      } else if (range.block.shift > 0) {
        divide(range, left);
      } else if (range.extra_levels > 0) {
        --range.extra_levels;
        left.push_back(range);
      } else {
        return too_small();
      }
    }
    return {};
  }

  void divide(const SearchRange& range, std::vector<SearchRange>& parts) const {
    SearchRange part = range;
    --part.block.shift;
    for (std::uint32_t octant = 8; octant-- > 0;) {
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        part.block.corner[axis] = range.block.corner[axis] + ((octant >> axis & 1u) << part.block.shift);
      }
      if (pipeline_.is_in_grid(part.block)) parts.push_back(part);
    }
  }

  // The host reads the points of the previous chunk while the device is busy.
  Result<Fill> run_chunk(const SearchRange& range) {
    if (Status submitted = submit(range); !submitted.ok()) return submitted.error();
    if (Status taken = take_points(); !taken.ok()) return taken.error();
    for (Commands* part : {&search_, &collection_}) {
      if (Status done = part->wait([&] { watch_.stopped(); }); !done.ok()) return done.error();
      Result<std::vector<StageTime>> times = part->recorder().stage_times();
      if (!times.ok()) return times.error();
      add_times(times.value(), extraction_.measurements.device_times);  // includes chunks that are run again
    }
    if (watch_.stopped()) return StopWatch::error();
    const auto counters = pipeline_.read_counters();
    const std::uint32_t overflow = counters[gpu::kOverflow];
    const Fill fill{counters[gpu::kUtilisation] / 1024.0, overflow != 0, overflow == gpu::kTooFewRounds};
    if (fill.too_few_rounds) pipeline_.add_rounds();
    if (fill.overflow) return fill;
    add_counters(counters, extraction_.measurements.counters);
    Status started =
        download_.start(pipeline_.result(), counters[gpu::kFound], pipeline_.undecided(), counters[gpu::kUndecided]);
    if (!started.ok()) return started.error();
    if (download_.is_shared()) {
      if (Status taken = take_points(); !taken.ok()) return taken.error();
    }
    return fill;
  }

  // In two parts: only the second writes to buffers from which points of the previous chunk may still be read.
  Status submit(const SearchRange& range) {
    for (Commands* part : {&search_, &collection_})
      if (Status begun = part->begin(); !begun.ok()) return begun;
    Status recorded = pipeline_.record(search_.recorder(), collection_.recorder(), range);
    if (!recorded.ok()) return recorded;
    if (Status submitted = search_.submit(nullptr, nullptr); !submitted.ok()) return submitted;
    return collection_.submit(download_.before_next(), nullptr);
  }

  Status take_points() {
    const Result<bool> there = download_.finish();
    if (!there.ok()) return there.error();
    if (!there.value()) return {};
    std::vector<MedialSphere>& spheres = extraction_.spheres;
    const std::size_t needed = spheres.size() + download_.points().size();
    if (needed > spheres.capacity()) spheres.reserve(std::max(needed, 2 * spheres.capacity()));
    for (const gpu::FoundPoint& p : download_.points()) spheres.push_back(to_input_units(p, mesh_));
    for (const gpu::UndecidedCell& u : download_.undecided()) extraction_.undecided.push_back(to_input_units(u, mesh_));
    return {};
  }

  const DeviceMesh& mesh_;
  CertifiedPipeline& pipeline_;
  std::uint32_t extra_levels_;
  StopWatch& watch_;
  Extraction& extraction_;
  Commands search_, collection_;
  ResultDownload download_;
};

}  // namespace

Result<Extraction> extract_certified(ContextImpl& context, DeviceMesh& mesh, const ExtractionOptions& options,
                                     StopWatch& watch) {
  Result<const StopWord*> stop = watch.make_word(context);
  if (!stop.ok()) return stop.error();
  Extraction extraction;
  extraction.grid = make_grid(mesh, options.resolution);
  extraction.side = mesh.side;
  auto pipeline = CertifiedPipeline::create(context, mesh, options, extraction.grid.size, *stop.value());
  if (!pipeline.ok()) return pipeline.error();
  extraction.measurements.counters.levels.resize(pipeline.value().level_count());
  for (std::uint32_t level = 0; level < pipeline.value().level_count(); ++level)
    extraction.measurements.counters.levels[level].cell_size = pipeline.value().cell_size(level);
  const auto record_one = [&](Recorder& r) { return pipeline.value().record(r, 0, 1); };
  if (Status made = make_programs(context, record_one); !made.ok()) return made.error();
  if (Status there = mesh.finish_uploads(); !there.ok()) return there.error();
  CertifiedRun run(context, mesh, pipeline.value(), options.extra_levels, watch, extraction);
  if (Status s = run.run(); !s.ok()) return s.error();
  ExtractionCounters& c = extraction.measurements.counters;
  c.narrowing_steps = pipeline.value().narrowing_steps();
  const std::size_t finest = c.levels.size() - 1 - options.extra_levels;
  c.proved_empty = c.levels[finest].visited - c.found - c.undecided;
  sort_by_voxel(extraction.spheres);
  sort_by_voxel(extraction.undecided);
  return extraction;
}

}  // namespace medial_vk
