#include "robots/model/pose.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {

Pose make_pose(const Point& xyz, const Point& rpy) {
  Pose pose;
  pose.shift = xyz;
  pose.turns = rpy != Point{0, 0, 0};
  if (!pose.turns) return pose;
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  pose.rotation = {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                    {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                    {-sp, cp * sr, cp * cr}}};
  return pose;
}

Point operator*(const Pose& pose, const Point& p) {
  if (!pose.turns) return p + pose.shift;
  return Point{dot(pose.rotation[0], p), dot(pose.rotation[1], p), dot(pose.rotation[2], p)} + pose.shift;
}

Pose operator*(const Pose& a, const Pose& b) {
  Pose result;
  result.turns = a.turns || b.turns;
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

// With u = 2^-53 and |p_i| <= c, |shift_i| <= t: sines and cosines are within 2u, an entry of the matrix, a sum of two
// products of up to three of them, within 12u. A coordinate of the product errs by 3 * (12u + 4u) c, the sum by
// u (2c + t) more; the vector by sqrt(3) times that: below 87u c + 2u t. Without a turn only the sum rounds, by u (c +
// t) per coordinate. A shift of zero is exact.
double placement_rounding(const Pose& pose, double reach) {
  constexpr double u = 0x1p-53;
  const double t = std::max({std::fabs(pose.shift[0]), std::fabs(pose.shift[1]), std::fabs(pose.shift[2])});
  if (pose.turns) return 96 * u * reach + 2 * u * t;
  return t == 0 ? 0 : 2 * u * (reach + t);
}

}  // namespace medial_vk
