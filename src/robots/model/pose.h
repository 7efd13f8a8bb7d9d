// Rigid motions in the convention of URDF: rotations about the fixed axes x, y, z by roll, pitch, yaw, then a shift.
#pragma once

#include <array>

#include "medial_vk/ball.h"

namespace medial_vk {

/// Maps p to rotation * p + shift.
struct Pose {
  std::array<Point, 3> rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< Rows.
  Point shift = {0, 0, 0};
  bool turns = false;  ///< False: `rotation` is exactly the unit matrix.
};

/// `rpy` in radians.
Pose make_pose(const Point& xyz, const Point& rpy);
Point operator*(const Pose& pose, const Point& p);
/// Applies `b` first, then `a`.
Pose operator*(const Pose& a, const Pose& b);

/// A bound of the distance of `pose * p` from its exact value by rounding, for points with coordinates of at most
/// `reach`.
double placement_rounding(const Pose& pose, double reach);

}  // namespace medial_vk
