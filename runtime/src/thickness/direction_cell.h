// Cells of directions from a point, as rectangles on the faces of a cube around it.
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

/// The directions through a rectangle on a face of the cube [-1, 1]^3 of a frame.
class DirectionCell {
 public:
  static constexpr std::size_t kFaces = 6;
  static constexpr std::size_t kParts = 4;

  /// A whole face; the first one is that of the third axis.
  static DirectionCell face(const CubeFrame& frame, std::size_t face);
  /// One of the quarters of the rectangle.
  DirectionCell part(const CubeFrame& frame, std::size_t index) const;

  /// Unit vectors. Each direction in the cell is a sum of the corners with weights that are not negative and have a sum
  /// of at least 1 and at most bulge().
  const FourDirections& corners() const { return corners_; }
  const Point& middle() const { return middle_; }
  double bulge() const { return bulge_; }

 private:
  DirectionCell(const CubeFrame& frame, std::uint8_t face, double x, double y, double half);

  FourDirections corners_;
  Point middle_;
  double bulge_;
  double x_, y_, half_;
  std::uint8_t face_;
};

}  // namespace medial_vk
