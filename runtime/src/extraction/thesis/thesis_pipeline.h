// The published method on the device: a recorded sequence, in parts, takes a chunk of top cells through the levels of
// Section 2.3.2 and through Algorithm 2. Nothing is read back before its end; counters on the device size every
// dispatch, and the buffers are large enough for any chunk.
//
//   for each level, coarse to fine:
//     centres of the cells -> distance and side -> spheres whose flux is needed -> flux -> cells that are kept
//   for each round of kRetractionsPerRound samples of the finest voxels without a point:
//     segments to the opposites -> those that cross the medial surface -> narrowing -> salient ends -> first of a voxel
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "device_commands/stop_word.h"
#include "device_mesh/device_mesh.h"
#include "medial_vk/medial_spheres.h"
#include "queries/flux_sampler.h"
#include "queries/tree_queries.h"
#include "thesis_types.h"

namespace medial_vk {

class ThesisPipeline {
 public:
  /// `mesh` and `stop` must outlive the pipeline. Errors: kOutOfMemory, kInternal.
  static Result<ThesisPipeline> create(ContextImpl& context, const DeviceMesh& mesh, const ExtractionOptions& options,
                                       const std::array<std::uint32_t, 3>& grid, const StopWord& stop);
  ThesisPipeline(ThesisPipeline&&) noexcept = default;

  std::uint32_t level_count() const { return levels_; }
  std::uint32_t samples(std::uint32_t level) const { return options_.thesis.samples[4 - levels_ + level]; }
  double cell_size(std::uint32_t level) const;
  /// Number of top cells; chunks are ranges of at most chunk_size() of them.
  std::uint32_t top_cells() const { return top_grid_[0] * top_grid_[1] * top_grid_[2]; }
  std::uint32_t chunk_size() const { return chunk_; }

  /// The work for top cells [first, first + count), in parts to be run in their order. (After a stop the dispatches of
  /// a part are empty; those of all parts would still take 0.2 s on lavapipe.)
  std::uint32_t part_count() const;
  Status record_part(Recorder& r, std::uint32_t part, std::uint32_t first, std::uint32_t count);

  /// Precondition: the recorded sequence has run.
  std::array<std::uint32_t, gpu::kCounterCount> read_counters() const;
  /// The first `count` points. Blocks.
  Result<std::vector<gpu::FoundPoint>> read_points(std::uint32_t count);

 private:
  ThesisPipeline(ContextImpl& context, const DeviceMesh& mesh, const ExtractionOptions& options, const StopWord& stop);

  /// Items of a dispatch: counters[counter] * multiplier.
  struct Items {
    std::uint32_t counter;
    std::uint32_t multiplier = 1;
  };
  Status allocate();
  Status upload_directions();
  gpu::ThesisConstants level_constants(std::uint32_t level, std::uint32_t first_cell) const;

  void record_level(Recorder& r, std::uint32_t level, std::uint32_t first_cell);
  void record_flux(Recorder& r, std::uint32_t level);
  void record_round(Recorder& r, std::uint32_t first_sample);
  void record_narrowing(Recorder& r, const gpu::ThesisConstants& step);
  void record_judgement(Recorder& r, const gpu::ThesisConstants& step);
  void record_result(Recorder& r);
  /// Copies the counts of tests by walks up to the end of a level.
  void copy_tests(Recorder& r, std::uint32_t level);

  /// One kernel over the items, then a barrier. The counters are bound before `buffers`.
  void run(Recorder& r, const char* shader, Items items, gpu::ThesisConstants step, std::vector<BufferRange> buffers,
           std::vector<std::uint32_t> constants = {});
  /// Exclusive sums of states_ in offsets_, their total in counters[total].
  void scan(Recorder& r, Items items, std::uint32_t total);
  /// Prepares counts of groups of `group_size` for the items, or for `count` of them from `first` on; returns their
  /// position in arguments_.
  VkDeviceSize prepare(Recorder& r, Items items, std::uint32_t divisor = 1,
                       std::uint32_t group_size = TreeQueries::kWorkgroupSize, std::uint32_t first = 0,
                       std::uint32_t count = 0xffffffffu, std::uint32_t least_items = 0);
  /// The items, at most `most`, in slices of a multiple of `group_size`.
  Slices slices(Items items, std::uint64_t most, std::uint32_t per_slice, std::uint32_t group_size);
  QueryCount query_count(Items items, std::uint64_t most);
  std::uint64_t cells_of(std::uint32_t level) const { return std::uint64_t{chunk_} << (3 * level); }
  std::uint64_t most_lines() const { return cells_of(levels_ - 1) * gpu::kRetractionsPerRound; }
  void copy_counter(Recorder& r, std::uint32_t from, std::uint32_t to);

  ContextImpl* context_;
  const DeviceMesh* mesh_;
  const StopWord* stop_;
  ExtractionOptions options_;
  Arena arena_;
  std::unique_ptr<TreeQueries> queries_;    // at a fixed address: the flux sampler refers to it
  std::unique_ptr<PacketQueries> packets_;  // likewise
  std::unique_ptr<FluxSampler> flux_;
  std::array<std::uint32_t, 3> grid_{};
  std::array<std::uint32_t, 3> top_grid_{};
  std::uint32_t levels_ = 4;
  std::uint32_t chunk_ = 1;
  std::uint32_t queries_per_slice_ = 1;  // greatest number of queries that walk the tree in a dispatch
  std::uint32_t next_argument_ = 0;

  Buffer counters_, counters_readback_, arguments_, directions_;
  std::vector<VkDeviceSize> directions_at_;  // per level: offset in directions_
  std::vector<Buffer> slots_;                // per level: slots of samples in packets
  Buffer cells_, kept_, nearest_, hits_, queries_at_, sides_at_, numbers_, empty_;
  Buffer states_, offsets_, block_sums_, spheres_, fluxes_;
  Buffer active_, still_active_, lines_, narrowed_, accepted_, points_, found_;
};

}  // namespace medial_vk
