// Rigid motions in space: rotations and shifts.
#pragma once

#include <array>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The rigid motion that maps p to rotation * p + shift, from a frame to another one.
struct Pose {
  /// The rows of a rotation matrix: perpendicular unit vectors, as far as rounding allows, of determinant 1.
  std::array<Point, 3> rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point shift = {0, 0, 0};  ///< In the units of the mesh.

  bool operator==(const Pose&) const = default;
};

/// Rotates about the fixed axes x, y and z, in this order, by the three angles in `rpy` (roll, pitch, yaw; radians),
/// then shifts. This is the convention of URDF. Entries of the rotation are exact to 12 * 2^-53.
Pose make_pose(const Point& shift, const Point& rpy);

/// The point in the other frame.
Point operator*(const Pose& pose, const Point& p);

/// Applies `b` first, then `a`.
Pose operator*(const Pose& a, const Pose& b);

}  // namespace medial_vk
