// The shape of the boundary at a tip, from the tips and spokes around it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "curvature/point_grid.h"

namespace medial_vk {

/// Points of the boundary with their outward unit normals.
struct TipCloud {
  std::vector<Point> tips, normals;
};

/// The second fundamental form at a tip.
struct TipFit {
  bool is_known = false;
  bool is_cut = false;  ///< As for a SheetFit, with the tips as points.
  Point normal = {0, 0, 0};
  /// As a symmetric matrix in space: its eigenvectors are the normal, with the eigenvalue 0, and the principal
  /// directions, with the principal curvatures, positive where the boundary is convex.
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
  double spread = 0;  ///< Standard deviation of a curvature by the residuals, were they independent.
};

/// A polynomial of degree 4 for the height, fitted to heights and slopes of the tips within `radius` whose spokes are
/// less than 66 degrees from that of the tip, of those that are kept. `grid` holds the tips of `cloud`.
/// `is_wide`: the result is not known where the boundary bends too much within the window.
TipFit fit_tip(const TipCloud& cloud, std::span<const std::uint8_t> is_kept, const PointGrid& grid, std::uint32_t tip,
               double radius, bool is_wide);

}  // namespace medial_vk
