#include "medial_vk/pose.h"

#include <cmath>
#include <cstddef>

#include "base/point_ops.h"

namespace medial_vk {

Pose make_pose(const Point& shift, const Point& rpy) {
  Pose pose;
  pose.shift = shift;
  if (rpy == Point{0, 0, 0}) return pose;
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  // Sines and cosines are within 2u, with u = 2^-53; an entry, a sum of two products of up to three of them, within
  // 12u.
  pose.rotation = {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                    {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                    {-sp, cp * sr, cp * cr}}};
  return pose;
}

Point operator*(const Pose& pose, const Point& p) {
  return Point{dot(pose.rotation[0], p), dot(pose.rotation[1], p), dot(pose.rotation[2], p)} + pose.shift;
}

Pose operator*(const Pose& a, const Pose& b) {
  Pose result;
  result.shift = a * b.shift;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      result.rotation[row][column] = a.rotation[row][0] * b.rotation[0][column] +
                                     a.rotation[row][1] * b.rotation[1][column] +
                                     a.rotation[row][2] * b.rotation[2][column];
    }
  }
  return result;
}

}  // namespace medial_vk
