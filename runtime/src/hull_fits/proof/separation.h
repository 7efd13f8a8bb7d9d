// Whether a plane separates a hull of balls from points, by a calculation whose rounding is bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// How far a plane across `u` is from separating: a lower bound of
///
///     min over the points t of  u . t  -  max over the balls of  (u . c + |u| r),
///
/// divided by an upper bound of |u|. If it is positive, a plane across u has all points, and so their convex hull, on
/// one side and the convex hull of the closed balls on the other. Minus infinity for u = 0 or a number that is not
/// finite: nothing is known then. Nothing else about u is assumed.
///
/// Rounding, with U = 2^-53: all points are taken relative to the first centre c', so that every difference has a
/// relative error of at most U; a product of two such vectors then has an error of at most 4.01 U (the difference, the
/// product of two numbers, two sums) times the sum of the absolute products. The computed square root of u . u is below
/// |u| by at most 2.51 U |u|, if u . u does not underflow, so it is multiplied by 1 + 4 U, and its product with r has a
/// relative error below 9 U, and is below |u| r by at most U of it. The last sum and difference add U of their terms
/// each. So 12 U times the sum of absolute products and of |u| r of the greatest point and ball bounds all of it. A
/// product that underflows has an error of 2^-1075 besides; there are seven of them between a point and a ball.
inline double separation(std::span<const Point> points, const BallHull& hull, const Point& u) {
  constexpr double kUnit = 0x1p-53;
  constexpr double kUnderflow = 0x1p-1070;
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  const double squared = dot(u, u);
  if (!(squared > 1e-280) || !std::isfinite(squared)) return kNothing;
  const double extent = std::sqrt(squared) * (1 + 4 * kUnit);
  const Point& origin = hull.corners[0].centre;
  const auto sum_of_absolutes = [&](const Point& offset) {
    return std::fabs(u[0] * offset[0]) + std::fabs(u[1] * offset[1]) + std::fabs(u[2] * offset[2]);
  };
  double least = std::numeric_limits<double>::infinity(), of_points = 0;
  // The minima and maxima below would pass over a number that is not one.
  bool are_finite = true;
  for (const Point& point : points) {
    const Point offset = point - origin;
    const double size = sum_of_absolutes(offset);
    are_finite = are_finite && std::isfinite(size);
    least = std::min(least, dot(u, offset));
    of_points = std::max(of_points, size);
  }
  double greatest = kNothing, of_balls = 0;
  for (const Ball& ball : hull.balls()) {
    const Point offset = ball.centre - origin;
    const double size = sum_of_absolutes(offset) + extent * ball.radius;
    are_finite = are_finite && std::isfinite(size);
    greatest = std::max(greatest, dot(u, offset) + extent * ball.radius);
    of_balls = std::max(of_balls, size);
  }
  const double margin = least - greatest - (12 * kUnit * (of_points + of_balls) + kUnderflow);
  if (!are_finite || !std::isfinite(margin)) return kNothing;
  // A division by a smaller number than |u| would make a positive margin too large, and one by a larger number would
  // make a negative margin too small in size.
  return margin / (margin > 0 ? extent : extent * (1 - 12 * kUnit));
}

}  // namespace medial_vk
