// Cells of directions from a point: the cones over triangles.
#pragma once

#include <array>
#include <cstdint>

#include "base/point_ops.h"
#include "thickness/contact_bounds.h"

namespace medial_vk {

/// Three perpendicular unit vectors.
struct CubeFrame {
  std::array<Point, 3> axes;

  /// With this unit vector as the third.
  static CubeFrame around(const Point& axis);
};

/// The directions that are sums of three unit vectors with weights that are not negative.
class DirectionCell {
 public:
  static constexpr std::size_t kParts = 2;
  /// Cells are not divided more often. Each time, the new corner is within 2 u of the arc between two others, so that
  /// directions between neighbouring cells are at most 64 u outside them, which is within Slack::product.
  static constexpr int kMostDivisions = 32;

  explicit DirectionCell(const std::array<Point, 3>& corners) : DirectionCell(corners, 0) {}

  /// One side of the line from the middle of the longest edge to the corner opposite to it.
  DirectionCell part(std::size_t index) const;
  bool can_be_divided() const { return divisions_ < kMostDivisions; }

  /// Unit vectors, of which the last two are equal. Each direction in the cell is a sum of the corners with weights
  /// that are not negative and have a sum of at least 1 and at most bulge(), which is infinite for cells that are too
  /// large.
  const FourDirections& corners() const { return corners_; }
  const Point& middle() const { return middle_; }
  double bulge() const { return bulge_; }

 private:
  DirectionCell(const std::array<Point, 3>& corners, int divisions);

  Point corner(std::size_t i) const { return {corners_[0][i], corners_[1][i], corners_[2][i]}; }

  FourDirections corners_;
  Point middle_;
  double bulge_;
  int divisions_;
};

}  // namespace medial_vk
