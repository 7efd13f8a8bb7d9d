// The certified extraction on the device (docs/theory.md): one recorded sequence takes a range of top cells from their
// contact lists to medial points. Nothing is read back before its end; counters on the device size every dispatch.
//
//   gather contacts of the top cells
//   for each level, coarse to fine and below the finest voxel:
//     mark the contacts of every child -> dismiss -> decide its side -> write the kept ones
//     at the finest level: one line across the nearest sheet for every voxel (the steps of lines are below)
//     from the finest level on, for the remaining cells: dismiss by pairs -> propose lines
//       -> keep those that turn -> narrow -> verify -> elect one per voxel; list undecided voxels
//   collect the points, measure their flux
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "device_commands/dispatch_arguments.h"
#include "device_commands/recorder.h"
#include "device_commands/stop_word.h"
#include "device_mesh/device_mesh.h"
#include "gpu_types.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// The capacity of the pipeline; a chunk of top cells that needs more is run again in smaller chunks, and a single top
/// cell in blocks of its voxels.
struct PipelineCapacity {
  std::uint32_t cells = 0;         // kept cells of one level
  std::uint32_t lines = 0;         // lines being narrowed at one level
  std::uint32_t list_entries = 0;  // of one level
  std::uint32_t flux_block = 0;    // points whose flux is measured at a time
};

/// A cube of 2^shift finest voxels along a side, at a multiple of that from the corner of the grid. The default holds
/// every grid.
struct GridBlock {
  std::array<std::uint32_t, 3> corner{};
  std::uint32_t shift = 31;
};

/// The part of an extraction that is recorded at once: `count` top cells from `first` on, of which only the voxels in
/// `block` are searched, down to so many levels below the finest voxel.
struct SearchRange {
  std::uint32_t first = 0, count = 0;
  GridBlock block;
  std::uint32_t extra_levels = 0;
};

class CertifiedPipeline {
 public:
  /// Allocates all buffers for one mesh and one set of parameters; `stop` outlives it. Errors: kOutOfMemory, kInternal.
  static Result<CertifiedPipeline> create(ContextImpl& context, const DeviceMesh& mesh,
                                          const ExtractionOptions& options, const std::array<std::uint32_t, 3>& grid,
                                          const StopWord& stop);

  /// Sets another box for the next record(), of the same longest side; memory stays that of create().
  void set_grid(const std::array<std::uint32_t, 3>& grid);
  /// Number of top cells; record() takes ranges of [0, top_cells()).
  std::uint32_t top_cells() const { return top_grid_[0] * top_grid_[1] * top_grid_[2]; }
  /// The voxels of a top cell.
  GridBlock block_of(std::uint32_t top_cell) const;
  /// True if it has voxels in the grid.
  bool is_in_grid(const GridBlock& block) const {
    return block.corner[0] < grid_[0] && block.corner[1] < grid_[1] && block.corner[2] < grid_[2];
  }
  /// The greatest number of top cells of one recorded sequence, whose states fit the buffers.
  std::uint32_t largest_chunk() const { return 8 * capacity_.cells; }
  /// The share of the buffers that a chunk should fill.
  double aim() const;
  /// A first estimate of the number of top cells for this share.
  std::uint32_t likely_chunk() const;
  std::uint32_t level_count() const { return coarse_levels_ + 1 + options_.extra_levels; }
  double cell_size(std::uint32_t level) const;
  std::uint32_t narrowing_steps() const { return narrowing_steps_; }

  /// Appends the whole extraction of `count` top cells from `first` on.
  Status record(Recorder& recorder, std::uint32_t first, std::uint32_t count) {
    return record(recorder, recorder, {first, count, {}, options_.extra_levels});
  }
  /// In two parts for one queue: only the collection writes result() and undecided().
  Status record(Recorder& search, Recorder& collection, const SearchRange& range);

  /// After kTooFewRounds: records twice as many rounds from now on. No list is longer than the mesh.
  void add_rounds() { rounds_ *= 2; }

  /// The buffers of the points, the undecided voxels and the counters, valid once the recorded sequence has run.
  const Buffer& result() const { return result_; }
  const Buffer& undecided() const { return undecided_; }
  const Buffer& counters() const { return counters_; }

  /// Precondition: the recorded sequence has run.
  std::array<std::uint32_t, gpu::kCounterCount> read_counters() const;

 private:
  CertifiedPipeline(ContextImpl& context, const DeviceMesh& mesh, const ExtractionOptions& options,
                    const StopWord& stop);

  // The buffers that one level reads and writes.
  struct LevelBuffers {
    const Buffer* parents;
    const Buffer* parent_lists;
    const Buffer* cells;
    const Buffer* lists;
  };
  enum class Source : std::uint32_t { kSections, kGrownEnds, kSamples, kOpposites };

  Status allocate(std::uint64_t memory_budget);
  std::uint32_t clusters_per_round() const;
  gpu::StepConstants level_constants(std::uint32_t level) const;

  std::uint32_t recorded_levels() const { return coarse_levels_ + 1 + range_.extra_levels; }

  void record_top_cells(Recorder& r);
  // Of the whole run. With kernel_times every dispatch is a stage of its own instead.
  void begin_stage(Recorder& r, const char* stage) const;
  void clear_counters(Recorder& r, std::initializer_list<std::uint32_t> counters);
  void record_steps(Recorder& r);
  void record_results(Recorder& r);
  void record_children(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level, bool finest);
  // The same where lists are of clusters.
  void record_clustered_children(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level);
  void decide_sides(Recorder& r, const gpu::StepConstants& step, std::uint32_t counter, const Buffer& parents);
  void decide_sides_and_make_room(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level);
  // The entries with a bit in `first_masks` come first in a child's list.
  void write_children(Recorder& r, gpu::StepConstants step, const LevelBuffers& level, const Buffer& first_masks,
                      bool finest);
  // One line for every cell. Cells without a point then are written to `left`.
  void record_first_search(Recorder& r, gpu::StepConstants step, const LevelBuffers& level, const Buffer& left);
  void record_search(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level);
  // From the proposed lines to the points of the voxels.
  void record_lines(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level);
  void record_narrowing(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level);
  void record_classification(Recorder& r, gpu::StepConstants step, const LevelBuffers& level);
  void record_drop_found(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level, const Buffer& left,
                         bool searched_once);
  void record_collection(Recorder& r);
  void record_flux(Recorder& r, std::uint32_t first);

  // The data of the mesh that a kernel reads: none, clusters of triangles, triangles, these and the tree, or these and
  // links. Texel views follow its buffers; all but clusters may have to be read as storage instead.
  enum class Reads : std::uint32_t { kNoMesh, kClusters, kTriangles, kTree, kLinks };
  std::vector<VkBufferView> texels_of(Reads reads) const;
  static constexpr std::uint32_t kEightLanes = 8;  // of a workgroup whose invocations walk together
  // Whether its invocations work alone, or eight together (shaders/shared/lanes/lanes.glsl).
  enum class Lanes : std::uint32_t { kAlone, kEight };
  // One kernel over counter * multiplier / divisor invocations.
  struct Kernel {
    const char* shader;
    std::vector<BufferRange> buffers;
    Reads reads = Reads::kNoMesh;
    std::vector<std::uint32_t> constants = {};
    std::uint32_t workgroup_size = 64;
    Lanes lanes = Lanes::kAlone;
  };
  struct Extent {
    std::uint32_t counter;
    std::uint32_t multiplier = 1;
    std::uint32_t divisor = 1;
    std::uint32_t first = 0;
    std::uint32_t limit = 0xffffffffu;
    std::uint32_t list_counter = gpu::kNoCounter;
    std::uint32_t queries = 0;                // closest-point queries per invocation, for the statistics
    std::uint32_t entry_limit = 0xffffffffu;  // of the lists counted by list_counter
  };
  void run(Recorder& r, const Kernel& kernel, const Extent& extent, const gpu::StepConstants& step);
  // The same for every round of so many entries of the lists.
  void run_rounds(Recorder& r, const Kernel& kernel, const Extent& extent, gpu::StepConstants step,
                  std::uint32_t entries = gpu::kEntriesPerRound);
  // A kernel that evaluates winding numbers: the tree is bound before the kernel's own buffers, open edges after them.
  Kernel side_kernel(const char* shader, std::vector<BufferRange> buffers) const;
  // The pairs of carriers of cells from `first` on, before their search or after (step.second_task).
  void judge_pairs(Recorder& r, gpu::StepConstants step, const LevelBuffers& level, std::uint32_t first,
                   std::uint32_t limit);
  // Sorts `items` by their numbers of contacts in work_, so that invocations that work together get about
  // equally many each.
  void sort_by_work(Recorder& r, gpu::StepConstants step, Extent items);
  void find_nearest(Recorder& r, Source source, const Extent& extent, const gpu::StepConstants& step,
                    const Buffer& cells, const Buffer& lists, const Buffer& points, const Buffer& nearest);
  // Changes counters: callers whose later dispatches depend on these, or on the overflow, must call counters_change().
  void scan(Recorder& r, const gpu::ScanConstants& constants);
  // The position of the group counts in arguments_.
  VkDeviceSize prepare(Recorder& r, gpu::DispatchConstants constants);

  ContextImpl* context_;
  const DeviceMesh* mesh_;
  const StopWord* stop_;
  ExtractionOptions options_;
  SearchRange range_;  // that is being recorded
  PipelineCapacity capacity_;
  Arena arena_;
  std::array<std::uint32_t, 3> grid_{};      // finest voxels
  std::array<std::uint32_t, 3> top_grid_{};  // top cells
  std::uint32_t top_shift_ = 2;              // a top cell is 2^this voxels
  std::uint32_t coarse_levels_ = 1;          // levels of children above the finest one
  std::uint32_t clustered_levels_ = 1;       // of these, the first ones, whose parents have lists of clusters
  std::uint32_t narrowing_steps_ = 0;
  std::uint32_t rounds_ = 1;  // recorded for lists longer than kEntriesPerRound
  DispatchArguments arguments_;

  Buffer counters_, counters_readback_;
  std::array<Buffer, 3> cells_, lists_;  // two to alternate between; [2] holds the finest voxels to the end
  Buffer nearest_, grown_nearest_, masks_, touch_masks_, counts_, requests_, open_, states_, offsets_, block_sums_;
  Buffer aims_, points_, work_, order_, lines_, winners_, given_up_, reasons_, voxel_points_, result_, undecided_;
  Buffer opposites_, sample_nearest_, opposite_nearest_, flux_tallies_;
};

}  // namespace medial_vk
