// Rigid motions in space: rotations and shifts.
#pragma once

#include <array>

#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

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

/// A rotation: by the angle 2 acos(w) about the direction (x, y, z), where the length is 1.
struct Quaternion {
  constexpr Quaternion(double of_x, double of_y, double of_z, double of_w) : x(of_x), y(of_y), z(of_z), w(of_w) {}

  double x, y, z, w;

  bool operator==(const Quaternion&) const = default;
};

/// Rotates by the quaternion, whose length is made 1, then shifts. Products of the rows of the rotation are within
/// 64 * 2^-53 of 0 and 1. Error: kUsage (the quaternion is 0, or a number is not finite).
Result<Pose> make_pose(const Point& shift, const Quaternion& rotation);

/// The point in the other frame.
Point operator*(const Pose& pose, const Point& p);

/// Applies `b` first, then `a`.
Pose operator*(const Pose& a, const Pose& b);

}  // namespace medial_vk
