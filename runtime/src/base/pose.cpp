#include "medial_vk/pose.h"

#include <algorithm>
#include <array>
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

Result<Pose> make_pose(const Point& shift, const Quaternion& rotation) {
  std::array<double, 4> q = {rotation.x, rotation.y, rotation.z, rotation.w};
  const auto is_finite = [](double number) { return std::isfinite(number); };
  double greatest = 0;
  for (const double number : q) greatest = std::max(greatest, std::fabs(number));
  if (!std::ranges::all_of(q, is_finite) || !std::ranges::all_of(shift, is_finite) || greatest == 0) {
    return Error{ErrorCode::kUsage,
                 "the quaternion `rotation` must not be 0, and all numbers of a pose must be finite"};
  }
  for (double& number : q) number /= greatest;  // squares neither overflow nor all vanish
  // Let u = 2^-53, and q be exact from here on: its direction is within u of the given one. The norm is within 3u, a
  // share, so that each of the four numbers of the unit quaternion is within 4u, and products of two within 9u. On the
  // diagonal, y^2 + z^2 <= 1: entries are within 2 (9u + u) + u = 21u. Off it, |xy| + |wz| <= 1/2: within 10u. A row is
  // thus within 26u of that of a rotation, as a vector, and a product of two rows within 52u and terms of u^2.
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& number : q) number /= norm;
  const auto [x, y, z, w] = q;
  return Pose{{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}},
              shift};
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
