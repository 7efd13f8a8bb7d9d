// What share of the volume each sheet accounts for, and what is left when sheets go (Chapter 6). docs/theory.md,
// "Significance".
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "medial_vk/shrinking_union.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Balls in sheets: sheet_of[i] is that of ball i, from 0 to `sheets` - 1.
struct SheetBalls {
  std::span<const Ball> balls;
  std::span<const std::int32_t> sheet_of;
  std::size_t sheets = 0;
  /// The same balls by the voxels they lie in, or nothing: then every ball is of its own sheet only.
  const VoxelGraph* graph = nullptr;
  double voxel_size = 0;  ///< Of these voxels; above 0 if there is a graph.
  /// How much of a sheet each ball stands for, where it is asked which sheets are around: seam_weights(). All alike if
  /// empty.
  std::span<const double> weights = {};
};

/// By point: its area; 0 for those of pieces that were too small for a sheet. Precondition: areas were measured. A ball
/// whose plane just touches its voxel has little or no weight and is of the sheets around it, as if it were at a seam.
std::vector<double> seam_weights(const Sheets& sheets);

/// Errors: those of measure_ball_union(); kInternal for sheets or weights that are not as said.
Result<Significance> measure_significance(const SheetBalls& sheets, unsigned threads);

/// Called before each sheet that is tried, with the share of the work done, as far as it can be told: what had to stay
/// may have to be tried again. It never falls. False stops.
using RemovalProgress = std::function<bool(double done)>;

/// Removes sheets by the rule until the next would leave less than `least_volume` of the whole volume; with 0, all that
/// may go. So what goes is a first part of what goes with 0. At least one stays. Of equal significance, the sheet with
/// the larger number goes first. Errors: those of ShrinkingUnion, kInterrupted.
Result<SheetRemoval> remove_sheets(const SheetBalls& sheets, const Significance& significance, RemovalRule rule,
                                   double least_volume, unsigned threads, const RemovalProgress& progress);

/// The first part of a removal that leaves at least `least_volume`: what remove_sheets() would have found for it.
SheetRemoval stop_at_volume(SheetRemoval removal, const Significance& significance, double least_volume);

}  // namespace medial_vk
