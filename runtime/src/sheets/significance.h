// The share of the volume that each sheet holds, and the volume left after the removal of sheets (Chapter 6).
// docs/theory.md, "Significance".
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "medial_vk/shrinking_union.h"
#include "medial_vk/significance.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// A ball belongs to the sheets with points within this fraction of its radius around its centre.
inline constexpr double kSeamReach = 0.7;

enum class RemovalRule {
  kSignificance,  ///< The least significant sheet is removed first (Section 6.3).
  /// The least significant sheet is removed first, among those without which the union has as many components, tunnels
  /// and cavities as the whole (Section 6.4.1).
  kTopology,
};

/// Balls in sheets: sheet_of[i] is the sheet of ball i, from 0 to `sheets` - 1.
struct SheetBalls {
  std::span<const Ball> balls;
  std::span<const std::int32_t> sheet_of;
  std::size_t sheets = 0;
  /// The same balls by the voxels they lie in, or null: then every ball belongs to its own sheet only.
  const VoxelGraph* graph = nullptr;
  double voxel_size = 0;  ///< Of these voxels; above 0 if there is a graph.
  /// The weight of each ball as a neighbour in the division of shares at seams: seam_weights(). Empty: equal weights.
  std::span<const double> weights = {};
};

/// By point: its area; 0 for points of components that were too small for a sheet. Precondition: areas were measured. A
/// ball whose plane just touches its voxel has little or no weight and belongs to the sheets around it, as if at a
/// seam.
std::vector<double> seam_weights(const Sheets& sheets);

/// Errors: those of measure_ball_union(); kInternal for invalid sheets or weights.
Result<Significance> measure_significance(const SheetBalls& sheets, unsigned threads);

/// Called before the trial of each sheet with an estimate of the finished share of the work, since sheets that had to
/// stay may be tried again. The share never decreases. The return value false stops the work.
using RemovalProgress = std::function<bool(double done)>;

/// Removes sheets by the rule until the next would leave less than `least_volume` of the whole volume; with 0, all that
/// the rule permits. The removed sheets are thus the first of those that are removed with 0. At least one sheet stays.
/// Of equal significance, the sheet with the larger number is removed first. Errors: those of ShrinkingUnion,
/// kInterrupted.
Result<SheetRemoval> remove_sheets(const SheetBalls& sheets, const Significance& significance, RemovalRule rule,
                                   double least_volume, unsigned threads, const RemovalProgress& progress);

/// The first part of a removal that leaves at least `least_volume`: the result of remove_sheets() for that value.
SheetRemoval stop_at_volume(SheetRemoval removal, const Significance& significance, double least_volume);

}  // namespace medial_vk
