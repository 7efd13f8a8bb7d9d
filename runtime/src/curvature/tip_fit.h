// The shape of the boundary at a tip, from the tips and spokes around it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "curvature/polynomial_fit.h"

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

/// A plane across the mean spoke of a window.
struct HeightFrame {
  Point x, y, up;
};

/// The boundary around a tip: a polynomial of degree 4 for the height over a plane.
struct TipPatch {
  static constexpr int kDegree = 4, kTerms = terms_of(kDegree);
  using Coefficients = Eigen::Matrix<double, kTerms, 1>;

  bool is_known = false;
  bool is_cut = false;  ///< As of TipFit.
  Point origin = {0, 0, 0};
  HeightFrame frame = {};
  double radius = 0;  ///< Of the window: the unit of the coordinates.
  Coefficients coefficients = Coefficients::Zero();
  double spread = 0;  ///< As of TipFit.

  /// Normal and form at the place of the graph over which p lies.
  void add_at(const Point& p, double weight, TipFit& sum) const;
};

/// A patch around tip `tip` of `cloud`, fitted to heights and slopes of the tips of `members` within `radius` whose
/// spokes are less than 66 degrees from that of the tip. `grid` holds the tips of `members`.
/// `is_wide`: the result is not known where the boundary bends too much within the window.
TipPatch fit_patch(const TipCloud& cloud, std::uint32_t tip, const TipCloud& members, const PointGrid& grid,
                   double radius, bool is_wide);

/// Whether a window around one of them holds the other one.
inline bool are_on_one_side(const Point& normal, const Point& other) {
  constexpr double kSimilarSpokes = 0.4;  // the slopes of those farther away are too steep for a height
  return dot(normal, other) > kSimilarSpokes;
}

}  // namespace medial_vk
