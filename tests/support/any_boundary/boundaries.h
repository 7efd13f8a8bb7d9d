// Boundaries with a known medial axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/any_boundary.h"

namespace medial_vk::test {

/// `nearest` and `is_inside` answer for one point.
inline BoundaryFunctions make_boundary(const std::function<Point(const Point&)>& nearest,
                                       const std::function<bool(const Point&)>& is_inside, const Point& lower,
                                       const Point& upper) {
  BoundaryFunctions boundary;
  boundary.nearest = [nearest](std::span<const Point> points, std::span<Point> answers) {
    std::transform(points.begin(), points.end(), answers.begin(), nearest);
  };
  if (is_inside) {
    boundary.contains = [is_inside](std::span<const Point> points, std::span<std::uint8_t> answers) {
      std::transform(points.begin(), points.end(), answers.begin(),
                     [&](const Point& p) { return is_inside(p) ? std::uint8_t{1} : std::uint8_t{0}; });
    };
  }
  boundary.lower = lower;
  boundary.upper = upper;
  return boundary;
}

/// A tube of radius 0.4 around the circle of radius 1 in the plane z = 0, which is its medial axis. Answers are
/// computed in the half plane of the point, so that they are on the torus also where it is close to the circle.
inline BoundaryFunctions torus() {
  const auto nearest = [](const Point& p) {
    const double across = std::hypot(p[0], p[1]), off = std::hypot(across - 1, p[2]);
    const double u = off > 0 ? (across - 1) / off : 0, v = off > 0 ? p[2] / off : 1;
    const double x = across > 0 ? p[0] / across : 1, y = across > 0 ? p[1] / across : 0;
    return Point{(1 + 0.4 * u) * x, (1 + 0.4 * u) * y, 0.4 * v};
  };
  const auto is_inside = [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) < 0.4; };
  return make_boundary(nearest, is_inside, {-1.4, -1.4, -0.4}, {1.4, 1.4, 0.4});
}

inline constexpr Point kHalfBox = {1, 0.6, 0.4};

inline Point nearest_on_box(const Point& p) {
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = std::clamp(p[k], -kHalfBox[k], kHalfBox[k]);
  if (q != p) return q;
  std::size_t face = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (kHalfBox[k] - std::fabs(p[k]) < kHalfBox[face] - std::fabs(p[face])) face = k;
  }
  q[face] = p[face] < 0 ? -kHalfBox[face] : kHalfBox[face];
  return q;
}

/// The surface of the box from -kHalfBox to kHalfBox.
inline BoundaryFunctions box() {
  const auto is_inside = [](const Point& p) {
    return std::fabs(p[0]) < kHalfBox[0] && std::fabs(p[1]) < kHalfBox[1] && std::fabs(p[2]) < kHalfBox[2];
  };
  return make_boundary(nearest_on_box, is_inside, -1.0 * kHalfBox, kHalfBox);
}

/// Points in space, which have no inside.
inline Point nearest_of(std::span<const Point> cloud, const Point& p) {
  return *std::min_element(cloud.begin(), cloud.end(),
                           [&](const Point& a, const Point& b) { return length(a - p) < length(b - p); });
}

inline BoundaryFunctions cloud(const std::vector<Point>& points, const Point& lower, const Point& upper) {
  return make_boundary([points](const Point& p) { return nearest_of(points, p); }, {}, lower, upper);
}

}  // namespace medial_vk::test
