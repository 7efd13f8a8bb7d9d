// The order of the dispatches of the certified extraction, straight-line.
#include "extraction/certified/certified_pipeline.h"

#include <algorithm>

namespace medial_vk {

using gpu::uint;

Status CertifiedPipeline::record(Recorder& search, Recorder& collection, const SearchRange& range) {
  range_ = range;
  Recorder nothing(*context_);
  arguments_.begin_plan();
  record_steps(nothing);
  record_results(nothing);
  arguments_.begin();
  record_steps(search);
  record_results(collection);
  return search.status().ok() ? collection.status() : search.status();
}

void CertifiedPipeline::record_results(Recorder& r) {
  record_collection(r);
  r.copy(counters_, 0, counters_readback_, 0, gpu::kCounterCount * 4);
  r.barrier_to_host();
}

void CertifiedPipeline::record_steps(Recorder& r) {
  begin_stage(r, "contacts");
  record_top_cells(r);
  // Levels alternate between two sets of buffers; the finest voxels have their own, which live to the end.
  uint parents = 0, lists = 0;
  for (uint level = 0; level <= coarse_levels_; ++level) {
    const bool finest = level == coarse_levels_;
    const uint target = finest ? 2 : 1 - parents;
    const LevelBuffers buffers{&cells_[parents], &lists_[lists], &cells_[target], &lists_[target]};
    const gpu::StepConstants step = level_constants(level);
    if (level < clustered_levels_)
      record_clustered_children(r, step, buffers);
    else
      record_children(r, step, buffers, finest);
    if (finest) {
      record_first_search(r, step, buffers, cells_[1]);
      const LevelBuffers left{nullptr, nullptr, &cells_[1], &lists_[2]};
      record_search(r, step, left);
      record_classification(r, step, left);
      record_drop_found(r, step, left, cells_[0], false);
    } else {
      arguments_.start(r, gpu::kStartChildren);
    }
    parents = lists = target;
  }
  // Below the finest voxel: the remaining cells are packed into cells_[0], children are written to cells_[1].
  for (uint level = coarse_levels_ + 1; level < recorded_levels(); ++level) {
    const uint target = lists == 0 ? 1 : 0;
    const LevelBuffers buffers{&cells_[0], &lists_[lists], &cells_[1], &lists_[target]};
    const gpu::StepConstants step = level_constants(level);
    record_children(r, step, buffers, false);
    record_search(r, step, buffers);
    record_classification(r, step, buffers);
    record_drop_found(r, step, buffers, cells_[0], false);
    lists = target;
  }
}

void CertifiedPipeline::record_top_cells(Recorder& r) {
  r.fill(counters_, 0, gpu::kCounterCount * 4, 0);
  r.barrier();
  r.fill(counters_, gpu::kParents * 4, 4, range_.count);
  r.barrier();
  gpu::StepConstants step = level_constants(0);
  // The constants of level 0 describe the children; a top cell is twice as large.
  const float margin = step.list_radius - step.circumradius;
  step.cell_size *= 2;
  step.circumradius *= 2;
  step.half_side *= 2;
  step.touch_half_side *= 2;
  step.list_radius = step.circumradius + margin;
  step.voxels_per_cell *= 2;
  step.first_item = range_.first;
  const Kernel gather{
      "gather_contacts",
      {counters_.range(), states_.range(), offsets_.range(), nearest_.range(), cells_[0].range(), lists_[0].range()},
      Reads::kClusters,
      {},
      kEightLanes,
      Lanes::kEight};
  const Extent top_cells{gpu::kParents};
  run(r, gather, top_cells, step);
  step.second_task = 1;
  decide_sides(r, step, gpu::kParents, cells_[0]);
  scan(r, {gpu::kParents, 1, gpu::kCells, gpu::kListEntries, gpu::kMaskWords, capacity_.cells, capacity_.list_entries,
           capacity_.list_entries / 32 + capacity_.cells});
  arguments_.counters_change();
  run(r, gather, top_cells, step);
  arguments_.start(r, gpu::kStartChildren);
}

void CertifiedPipeline::clear_counters(Recorder& r, std::initializer_list<std::uint32_t> counters) {
  for (const std::uint32_t counter : counters) r.fill(counters_, VkDeviceSize{counter} * 4, 4, 0);
  r.barrier();
}

void CertifiedPipeline::record_children(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level,
                                        bool finest) {
  begin_stage(r, "dismissal");
  const Buffer& axes = offsets_;  // large enough, and unused until the prefix sums
  const Extent children{gpu::kParents, 8, 1, 0, 0xffffffffu, gpu::kLongestParentList};
  Extent queried = children;
  queried.queries = 1;
  clear_counters(r, {gpu::kRequests, gpu::kOpen});
  run_rounds(r,
             {"mark_contacts",
              {mesh_->storage_of(mesh_->triangles), level.parents->range(), level.parent_lists->range(),
               counters_.range(), nearest_.range(), masks_.range(), touch_masks_.range(), counts_.range(), axes.range(),
               states_.range(), open_.range(), requests_.range()},
              Reads::kTriangles,
              {},
              64,
              Lanes::kEight},
             queried, step);
  run(r,
      {"dismiss_cells",
       {mesh_->storage_of(mesh_->triangles), level.parents->range(), level.parent_lists->range(), counters_.range(),
        nearest_.range(), touch_masks_.range(), open_.range(), axes.range(), states_.range(), requests_.range(),
        counts_.range()},
       Reads::kTriangles},
      {gpu::kOpen}, step);
  decide_sides_and_make_room(r, step, level);
  if (finest) {  // every finest voxel that is kept gets a slot
    r.copy(counters_, gpu::kCells * 4, counters_, gpu::kVoxels * 4, 4);
    r.barrier();
  }
  write_children(r, step, level, touch_masks_, finest);
}

// For the children listed by kRequests, or, as its second task, for all top cells (kParents).
void CertifiedPipeline::decide_sides(Recorder& r, const gpu::StepConstants& step, std::uint32_t counter,
                                     const Buffer& parents) {
  run(r,
      side_kernel("decide_side",
                  {counters_.range(), parents.range(), nearest_.range(), states_.range(), requests_.range()}),
      {counter}, step);
}

void CertifiedPipeline::decide_sides_and_make_room(Recorder& r, const gpu::StepConstants& step,
                                                   const LevelBuffers& level) {
  decide_sides(r, step, gpu::kRequests, *level.parents);
  // Kernels that write children are sized before the overflow is known: they test it themselves.
  scan(r, {gpu::kParents, 8, gpu::kCells, gpu::kListEntries, gpu::kMaskWords, capacity_.cells, capacity_.list_entries,
           capacity_.list_entries / 32 + capacity_.cells});
}

void CertifiedPipeline::write_children(Recorder& r, gpu::StepConstants step, const LevelBuffers& level,
                                       const Buffer& first_masks, bool finest) {
  step.second_task = finest ? 1 : 0;
  run_rounds(r,
             {"write_children",
              {level.parents->range(), level.parent_lists->range(), counters_.range(), masks_.range(),
               first_masks.range(), states_.range(), offsets_.range(), nearest_.range(), level.cells->range(),
               level.lists->range(), counts_.range(), winners_.range(), given_up_.range(), reasons_.range()}},
             {gpu::kParents, 8, 1, 0, 0xffffffffu, gpu::kLongestParentList}, step);
  arguments_.counters_change();  // the longest list
}

void CertifiedPipeline::record_clustered_children(Recorder& r, const gpu::StepConstants& step,
                                                  const LevelBuffers& level) {
  begin_stage(r, "dismissal");
  const Extent children{gpu::kParents, 8};
  clear_counters(r, {gpu::kRequests});
  run(r,
      {"mark_clusters",
       {level.parents->range(), level.parent_lists->range(), counters_.range(), nearest_.range(), masks_.range(),
        touch_masks_.range(), counts_.range(), states_.range(), requests_.range()},
       Reads::kClusters,
       {},
       kEightLanes,
       Lanes::kEight},
      children, step);
  decide_sides_and_make_room(r, step, level);
  if (step.lists == gpu::kListsClusters) {
    write_children(r, step, level, masks_, false);
    return;
  }
  run_rounds(r,
             {"expand_clusters",
              {mesh_->storage_of(mesh_->triangles), mesh_->clusters.range(), level.parents->range(),
               level.parent_lists->range(), counters_.range(), masks_.range(), states_.range(), offsets_.range(),
               nearest_.range(), level.cells->range(), level.lists->range(), counts_.range()},
              Reads::kTriangles,
              {},
              kEightLanes,
              Lanes::kEight},
             {gpu::kParents, 8 * kEightLanes, 1, 0, 0xffffffffu, gpu::kLongestParentList}, step, clusters_per_round());
  arguments_.counters_change();  // the longest list
}

void CertifiedPipeline::record_first_search(Recorder& r, gpu::StepConstants step, const LevelBuffers& level,
                                            const Buffer& left) {
  begin_stage(r, "search");
  step.lines_per_cell = 1;
  run(r,
      {"propose_crossings",
       {mesh_->storage_of(mesh_->triangles), level.cells->range(), counters_.range(), points_.range(), work_.range()},
       Reads::kTriangles},
      {gpu::kCells}, step);
  record_lines(r, step, level);
  record_drop_found(r, step, level, left, true);
}

void CertifiedPipeline::record_search(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level) {
  begin_stage(r, "pairs");
  if (mesh_->has_untrusted && step.depth > 0 && step.open_edges <= gpu::kMostOpenEdges)
    run(r, side_kernel("measure_levels", {counters_.range(), level.cells->range()}), {gpu::kCells}, step);
  judge_pairs(r, step, level, 0, capacity_.cells);
  begin_stage(r, "search");
  run(r,
      {"propose_lines",
       {mesh_->storage_of(mesh_->triangles), level.cells->range(), level.lists->range(), counters_.range(),
        aims_.range(), points_.range(), work_.range()},
       Reads::kTriangles,
       {},
       64,
       Lanes::kEight},
      {gpu::kCells, gpu::kLinesPerCell}, step);
  record_lines(r, step, level);
}

void CertifiedPipeline::record_lines(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level) {
  const Extent seeds{gpu::kCells, step.lines_per_cell};
  if (step.depth <= gpu::kSortedDepth) sort_by_work(r, step, seeds);
  // Their queries are counted where they are proposed: most seeds have none. The first round always runs: a cell's list
  // has at least its nearest triangle (Lemma A), so it is never empty at a level with cells.
  run_rounds(r,
             {"find_line_ends",
              {mesh_->storage_of(mesh_->triangles), level.cells->range(), level.lists->range(), counters_.range(),
               points_.range(), nearest_.range(), masks_.range(), states_.range(), order_.range()},
              Reads::kTriangles},
             {gpu::kCells, step.lines_per_cell, 1, 0, 0xffffffffu, gpu::kLongestCellList}, step);
  scan(r, {gpu::kCells, step.lines_per_cell, gpu::kLines, gpu::kIgnored, gpu::kIgnored, capacity_.lines, 0xffffffffu,
           0xffffffffu});
  arguments_.counters_change();
  run(r,
      {"start_lines",
       {mesh_->storage_of(mesh_->triangles), counters_.range(), points_.range(), nearest_.range(), states_.range(),
        offsets_.range(), level.cells->range(), lines_.range(), work_.range()},
       Reads::kTriangles},
      seeds, step);
  record_narrowing(r, step, level);
}

void CertifiedPipeline::sort_by_work(Recorder& r, gpu::StepConstants step, Extent items) {
  step.items_counter = items.counter;
  step.items_multiplier = items.multiplier;
  items.divisor = gpu::kSortedPerLane;
  run(r, {"sort_by_work", {counters_.range(), work_.range(), order_.range()}}, items, step);
}

void CertifiedPipeline::record_narrowing(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level) {
  const Extent lines{gpu::kLines, 1, 1, 0, 0xffffffffu, gpu::kLongestCellList};
  if (step.depth <= gpu::kSortedDepth) sort_by_work(r, step, {gpu::kLines});
  for (uint i = 0; i < narrowing_steps_; ++i) {
    find_nearest(r, Source::kSections, lines, step, *level.cells, *level.lists, points_, nearest_);
    run(r,
        {"narrow_lines",
         {mesh_->storage_of(mesh_->triangles), counters_.range(), lines_.range(), nearest_.range(),
          level.cells->range()},
         Reads::kTriangles},
        {gpu::kLines}, step);
  }
  clear_counters(r, {gpu::kRequests});
  find_nearest(r, Source::kGrownEnds, lines, step, *level.cells, *level.lists, points_, grown_nearest_);
  run(r, side_kernel("decide_line_side", {counters_.range(), lines_.range(), requests_.range(), winners_.range()}),
      {gpu::kRequests}, step);
}

// Cells are given up at the last level; next to untrusted triangles of the boundary, some are given up earlier, from
// kBoundaryDepth on.
void CertifiedPipeline::record_classification(Recorder& r, gpu::StepConstants step, const LevelBuffers& level) {
  const bool some_settle =
      (step.ends & gpu::kEndsSettled) != 0u || (step.depth >= gpu::kBoundaryDepth && mesh_->has_untrusted);
  if ((step.ends & gpu::kEndsAll) == 0u && !some_settle) return;
  begin_stage(r, "classification");
  step.second_task = 1;
  // At levels with little subdivision these cells are many, with long lists; a stop waits for one block. At deeper
  // levels they are few, and most blocks would be empty: there each block is as large as all before it.
  constexpr uint kBlock = 4096;
  for (uint first = 0; first < capacity_.cells;) {
    const uint block = step.depth > 1 ? std::max(first, kBlock) : kBlock;
    judge_pairs(r, step, level, first, block);
    arguments_.counters_change();  // a stop waits for one block
    first += block;
  }
}

void CertifiedPipeline::record_drop_found(Recorder& r, const gpu::StepConstants& step, const LevelBuffers& level,
                                          const Buffer& left, bool searched_once) {
  const Extent cells{gpu::kCells};
  gpu::StepConstants drop = step;
  drop.second_task = searched_once ? 1 : 0;
  run(r,
      {"drop_found",
       {counters_.range(), level.cells->range(), winners_.range(), lines_.range(), cells_[2].range(), given_up_.range(),
        voxel_points_.range(), states_.range()}},
      cells, drop);
  // Only existing cells are kept: this cannot overflow, and the kernel that gathers them is sized already.
  scan(r, {gpu::kCells, 1, gpu::kKept, gpu::kIgnored, gpu::kIgnored, capacity_.cells, 0xffffffffu, 0xffffffffu});
  run(r, {"gather_cells", {counters_.range(), states_.range(), offsets_.range(), level.cells->range(), left.range()}},
      cells, step);
  arguments_.start(r, searched_once ? gpu::kStartAgain : gpu::kStartBelow);
}

void CertifiedPipeline::record_collection(Recorder& r) {
  begin_stage(r, "flux");
  gpu::StepConstants step = level_constants(coarse_levels_);
  const Kernel collect{"collect_points",
                       {counters_.range(), winners_.range(), states_.range(), offsets_.range(), voxel_points_.range(),
                        result_.range(), cells_[2].range(), reasons_.range(), undecided_.range(), given_up_.range()}};
  run(r, collect, {gpu::kVoxels}, step);
  scan(r, {gpu::kVoxels, 1, gpu::kFound, gpu::kUndecided, gpu::kIgnored, capacity_.cells, 0xffffffffu, 0xffffffffu});
  arguments_.counters_change();
  step.second_task = 1;
  run(r, collect, {gpu::kVoxels}, step);
  for (uint first = 0; first < capacity_.cells; first += capacity_.flux_block) record_flux(r, first);
}

void CertifiedPipeline::record_flux(Recorder& r, std::uint32_t first) {
  gpu::StepConstants step = level_constants(coarse_levels_);
  step.first_item = first;
  const Extent points{gpu::kFound, 1, 1, first, capacity_.flux_block, gpu::kNoCounter};
  constexpr uint kGroups = gpu::kFluxSamples / gpu::kFluxGroup;
  const Extent groups{gpu::kFound, kGroups, 1, first * kGroups, capacity_.flux_block * kGroups};
  run_rounds(r,
             {"mark_samples",
              {mesh_->storage_of(mesh_->triangles), cells_[2].range(), lists_[2].range(), counters_.range(),
               result_.range(), masks_.range(), work_.range()},
              Reads::kTriangles,
              {},
              64,
              Lanes::kEight},
             groups, step);
  gpu::StepConstants of_groups = step;
  of_groups.first_item = first * kGroups;
  gpu::StepConstants counted = of_groups;
  counted.second_task = 1;
  sort_by_work(r, counted, groups);
  // The positions of samples are implicit: no buffer holds them.
  find_nearest(r, Source::kSamples, groups, of_groups, cells_[2], lists_[2], opposites_, sample_nearest_);
  clear_counters(r, {gpu::kRequests});
  run(r,
      {"choose_opposites",
       {mesh_->storage_of(mesh_->triangles), counters_.range(), result_.range(), sample_nearest_.range(),
        opposites_.range(), flux_tallies_.range(), requests_.range()},
       Reads::kTriangles},
      points, step);
  find_nearest(r, Source::kOpposites, {gpu::kRequests}, of_groups, cells_[2], lists_[2], opposites_, opposite_nearest_);
  run(r,
      {"measure_flux",
       {mesh_->storage_of(mesh_->triangles), counters_.range(), result_.range(), sample_nearest_.range(),
        opposites_.range(), opposite_nearest_.range(), flux_tallies_.range()},
       Reads::kTriangles},
      points, step);
}

}  // namespace medial_vk
