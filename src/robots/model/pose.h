// Rigid motions as URDF has them: fixed axes x, y, z by roll, pitch, yaw, then a shift.
#pragma once

#include <array>

#include "medial_vk/ball.h"

namespace medial_vk {

/// p goes to rotation * p + shift.
struct Pose {
  std::array<Point, 3> rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< Rows.
  Point shift = {0, 0, 0};
  bool turns = false;  ///< False: `rotation` is the unit matrix, exactly.
};

/// `rpy` in radians.
Pose make_pose(const Point& xyz, const Point& rpy);
Point operator*(const Pose& pose, const Point& p);
/// First `b`, then `a`.
Pose operator*(const Pose& a, const Pose& b);

/// How far `pose * p` may be from the true image of p, by rounding, for points whose coordinates are at most `reach`.
double placement_rounding(const Pose& pose, double reach);

}  // namespace medial_vk
