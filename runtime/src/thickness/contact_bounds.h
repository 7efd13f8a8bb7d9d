// What one point of the boundary says about balls that come close to another one, in many directions at once
// (docs/theory.md, "Thickness").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/eight_floats.h"
#include "base/point_ops.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// A point q of the boundary, up to rounding, relative to the point p that balls come close to: with `at` = q and
/// `squared` = |q|^2, no ball around m has a greater squared radius than |m - q|^2 = |m|^2 - 2 m.at + squared. The
/// right side is linear in both, so a mixture of two contacts, with weights of sum 1, bounds balls as well.
struct Contact {
  Point at = {0, 0, 0};
  double squared = 0;
};

/// Unit vectors, by axis and then by vector.
using FourDirections = std::array<std::array<double, 4>, 3>;

/// Bounds are widened by this factor for the rounding of some twenty operations.
constexpr double kBoundRounding = 1 + 0x1p-46;

/// Where squares are subtracted, they are first changed by this share of them, above the rounding of |q|^2, (u.q)^2 and
/// their difference.
constexpr double kSquareRounding = 0x1p-47;

inline std::array<double, 4> along(const FourDirections& directions, const Point& at) {
  std::array<double, 4> products;
  for (std::size_t i = 0; i < 4; ++i) {
    products[i] = directions[0][i] * at[0] + directions[1][i] * at[1] + directions[2][i] * at[2];
  }
  return products;
}

inline double least_of(const std::array<double, 4>& v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
inline double most_of(const std::array<double, 4>& v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

struct Slack {
  double distance = 0;  // delta and the rounding of distances
  double product = 0;   // the same and the rounding of u.q
};

/// The greatest distance s from p, in a direction u with u.q = `along` for the contact q, of a centre m = s u with
/// |m - p| <= |m - q| + slack: squared, this is s (2 u.q - 2 slack) <= |q|^2 - slack^2. Infinite if u.q <= slack.
MEDIAL_VK_INLINE double reach_by(double squared_length, double along, const Slack& slack) {
  const double beyond = along - slack.product;
  const double squared = squared_length * (1 + kSquareRounding) - slack.distance * slack.distance;
  const double reach = (squared > 0 ? squared : 0) / (2 * beyond) * kBoundRounding;
  return beyond > 0 ? reach : std::numeric_limits<double>::infinity();
}
inline double reach_by(const Contact& contact, double along, const Slack& slack) {
  return reach_by(contact.squared, along, slack);
}

/// Distances from p at which the point in a direction u is within `radius` of a point q, for u.q = `product`; empty if
/// the lower bound is above the upper one.
inline Bounds distances_near(double product, double squared, double radius) {
  const double rest = radius * radius * (1 - kSquareRounding) - squared * (1 + kSquareRounding);
  const double half = std::sqrt(std::max(0.0, rest + product * product));
  if (!(half > 0)) return {1, 0};
  return {(product - half) * kBoundRounding, (product + half) / kBoundRounding};
}

/// The same in all four directions.
inline Bounds distances_near(const FourDirections& directions, const Contact& contact, double radius) {
  Bounds near = {0, std::numeric_limits<double>::infinity()};
  for (const double product : along(directions, contact.at)) {
    const Bounds one = distances_near(product, contact.squared, radius);
    near = {std::max(near.lower, one.lower), std::min(near.upper, one.upper)};
    if (near.lower > near.upper) return near;
  }
  return near;
}

/// The mixture of two contacts whose bound is stationary at m along the ray from p: (m - at).m = 0. None if that is no
/// mixture with positive weights.
inline std::optional<Contact> mixture(const Contact& a, const Contact& b, const Point& m) {
  const double before = dot(m - a.at, m), beyond = dot(b.at - m, m), sum = before + beyond;
  if (!(before > 0 && beyond > 0)) return std::nullopt;
  const double of_a = beyond / sum, of_b = before / sum;
  return Contact{of_a * a.at + of_b * b.at, of_a * a.squared + of_b * b.squared};
}

}  // namespace medial_vk
