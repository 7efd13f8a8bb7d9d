// Points of triangles that move with them, and directions that triangles carry.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/point_ops.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

using Corners3 = std::array<Point, 3>;

/// A point of a triangle by its barycentric coordinates (Section 7.4.1): corner 0, and shares of the edges from there
/// to the corners 1 and 2.
struct SurfacePoint {
  std::uint32_t triangle = BvhHit().triangle;
  double v = 0, w = 0;

  bool is_known() const { return triangle != BvhHit().triangle; }
  /// The weights of the corners.
  std::array<double, 3> shares() const { return {1 - v - w, v, w}; }
  /// False on edges and corners, up to rounding.
  static constexpr double kOnSide = 1e-9;
  bool is_within_face() const { return v > kOnSide && w > kOnSide && v + w < 1 - kOnSide; }
};

inline Point point_at(const SurfacePoint& point, const Corners3& corners) {
  return corners[0] + point.v * (corners[1] - corners[0]) + point.w * (corners[2] - corners[0]);
}

/// The coordinates of `point`, a point of the triangle up to rounding.
SurfacePoint surface_point_at(const Point& point, std::uint32_t triangle, const Corners3& corners);

/// Towards the inside, of length 1; 0 where the triangle has no area. `front`: 1 if it is counter-clockwise seen from
/// outside, else -1.
Point inward_normal_of(const Corners3& corners, double front);

/// The inward normal of the surface, by its component along that of a triangle: the image of a unit vector under F^-T,
/// with F the map of the triangle and its inward unit normal from one frame to the next, of length 1. `front` as above,
/// in either frame. None by a triangle that has no area in one of the frames.
std::optional<Point> carried_direction(const Point& direction, const Corners3& corners, double front,
                                       const Corners3& new_corners, double new_front);

}  // namespace medial_vk
