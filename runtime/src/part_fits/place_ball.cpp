#include "part_fits/place_ball.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kU = 0x1p-53;  // the unit roundoff, u below
constexpr double kMostDeviation = 1e-6;

double greatest_coordinate(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

bool turns(const Pose& pose) { return pose.rotation != Pose().rotation; }

/// The greatest row sum of |R R^T - 1|. With singular values s it is at least |s^2 - 1| >= |s - 1|, so the matrix
/// differs from the nearest orthogonal one by no more, in the norm of vectors. Its own rounding is below 10u.
double deviation_of(const Pose& pose) {
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += std::fabs(dot(pose.rotation[i], pose.rotation[k]) - (i == k ? 1.0 : 0.0));
    }
    greatest = std::max(greatest, sum);
  }
  return greatest;
}

}  // namespace

// With |p_i| <= c and |shift_i| <= t: an entry of a matrix by make_pose() is within 12u. A coordinate of the product
// errs by 3 * (12u + 4u) c, the sum by u (2c + t) more; the vector by sqrt(3) times that: below 87u c + 2u t. Other
// matrices move a point by no more than their deviation times sqrt(3) c instead of the 12u; what remains of the 87u is
// below 25u. Without a turn only the sum rounds, by u (c + t) per coordinate. A shift of zero is exact.
double placement_rounding(const Pose& pose, double reach) {
  const double t = greatest_coordinate(pose.shift);
  if (!turns(pose)) return t == 0 ? 0 : 2 * kU * (reach + t);
  return std::max(96 * kU, 25 * kU + 1.74 * (deviation_of(pose) + 10 * kU)) * reach + 2 * kU * t;
}

bool is_rigid(const Pose& pose) {
  const auto& [x, y, z] = pose.rotation;
  for (const Point& row : pose.rotation) {
    if (!std::ranges::all_of(row, [](double entry) { return std::fabs(entry) <= 2; })) return false;
  }
  if (!std::ranges::all_of(pose.shift, [](double length) { return std::isfinite(length); })) return false;
  return deviation_of(pose) <= kMostDeviation && dot(x, cross(y, z)) > 0;
}

Ball place_ball(const Pose& pose, const Ball& ball, int grow) {
  const double rounding = placement_rounding(pose, greatest_coordinate(ball.centre));
  Ball placed = {pose * ball.centre, ball.radius};
  if (rounding == 0 || grow == 0) return placed;
  // The sum is rounded too.
  placed.radius = std::nextafter(ball.radius + grow * rounding, grow > 0 ? std::numeric_limits<double>::infinity() : 0);
  placed.radius = std::max(placed.radius, 0.0);
  return placed;
}

}  // namespace medial_vk
