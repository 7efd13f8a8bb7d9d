// The edges and the face of the axis of a hull, with all that closed forms of distances need of them.
//
// Each is stored in an orthonormal frame of its own, and every closed form works in that frame alone. Rounding then has
// the effect of moving the balls by a few units in the last place of the axis' length (or of the distance to the point,
// where that is greater), however thin a triangle is: a distance changes by no more than the balls move.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// Below this share of a length, what is left of it by a subtraction is rounding.
constexpr double kAxisRounding = 0x1p-50;

/// `unit` made perpendicular to the unit vector `axis`, of unit length: for a difference of nearly parallel vectors,
/// whose direction is perpendicular only up to rounding over its length.
inline Point orthogonalized(const Point& unit, const Point& axis) {
  const Point across = unit - dot(unit, axis) * axis;
  return (1 / length(across)) * across;
}

/// The segment between two centres.
struct AxisEdge {
  std::uint8_t from = 0, to = 0;
  bool is_cone = false;  // false: one ball holds the other, and nothing below is set
  Point direction = {};  // of unit length
  double extent = 0;     // the distance of the centres
  double slope = 0;      // of the radius
  double ahead = 0;      // slope / sqrt(1 - slope^2)

  AxisEdge() = default;
  AxisEdge(const BallHull& hull, std::uint8_t i, std::uint8_t j) : from(i), to(j) {
    const Point along = hull.corners[j].centre - hull.corners[i].centre;
    extent = length(along);
    const double growth = hull.corners[j].radius - hull.corners[i].radius;
    is_cone = std::fabs(growth) < extent;
    if (!is_cone) return;
    direction = (1 / extent) * along;
    // The quotient of a double by a greater one rounds to at most 1 - 2^-53, so that `ahead` is finite.
    slope = growth / extent;
    ahead = slope / std::sqrt((1 - slope) * (1 + slope));
  }
};

/// The triangle of three centres, in the frame of its longest side. It exists if the gradient of the radius is shorter
/// than 1, which holds if and only if the hull has two flat triangles.
struct AxisFace {
  bool exists = false;
  std::uint8_t from = 0, to = 0, third = 0;    // the longest side, and the corner opposite it
  Point along = {}, across = {}, normal = {};  // orthonormal; the third corner is ahead of the side
  double extent = 0;                           // of the side
  double third_along = 0, third_across = 0;    // where the third corner is, from the first
  double slope_along = 0, slope_across = 0;    // the gradient of the radius
  double cosine = 0;                           // sqrt(1 - |gradient|^2): of the flat triangles' normals to `normal`
  double ahead_along = 0, ahead_across = 0;    // gradient / cosine
  double inverse_extent = 0, inverse_across = 0;

  AxisFace() = default;
  explicit AxisFace(const BallHull& hull) {
    std::array<double, 3> squared{};  // of the side opposite a corner
    std::array<Point, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
      side[k] = hull.corners[(k + 2) % 3].centre - hull.corners[(k + 1) % 3].centre;
      squared[k] = dot(side[k], side[k]);
    }
    third = squared[0] >= squared[1] ? (squared[0] >= squared[2] ? 0 : 2) : (squared[1] >= squared[2] ? 1 : 2);
    from = static_cast<std::uint8_t>((third + 1) % 3);
    to = static_cast<std::uint8_t>((third + 2) % 3);
    extent = std::sqrt(squared[third]);
    if (!(extent > 0)) return;
    inverse_extent = 1 / extent;
    along = inverse_extent * side[third];
    const Point offset = -1.0 * side[to];  // from `from` to `third`
    third_along = dot(offset, along);
    const Point rest = offset - third_along * along;
    third_across = length(rest);
    if (!(third_across > kAxisRounding * extent)) return;  // on the side, up to rounding
    inverse_across = 1 / third_across;
    across = inverse_across * rest;
    if (third_across < 0.25 * extent) across = orthogonalized(across, along);
    normal = cross(along, across);
    const double first = hull.corners[from].radius;
    slope_along = (hull.corners[to].radius - first) * inverse_extent;
    slope_across = (hull.corners[third].radius - first - slope_along * third_along) * inverse_across;
    const double rest_of_one = (1 - slope_along) * (1 + slope_along) - slope_across * slope_across;
    if (!(rest_of_one > 0)) return;
    exists = true;
    cosine = std::sqrt(rest_of_one);
    ahead_along = slope_along / cosine;
    ahead_across = slope_across / cosine;
  }

  /// The weights of the point of the plane at (x, y), by ball.
  std::array<double, 3> weights_at(double x, double y) const {
    std::array<double, 3> weight{};
    weight[third] = y * inverse_across;
    weight[to] = (x - weight[third] * third_along) * inverse_extent;
    weight[from] = 1 - weight[to] - weight[third];
    return weight;
  }
};

}  // namespace medial_vk
