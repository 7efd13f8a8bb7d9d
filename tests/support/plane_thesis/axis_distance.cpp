#include "support/plane_thesis/axis_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plane/sites/vec2.h"

namespace medial_vk::test {
namespace {

using plane::Vec2;

constexpr int kParts = 32;       // of an arc, in which its distance from anything has one minimum
constexpr int kNarrowings = 80;  // of such a part by a third
constexpr double kNear = 1e-9;

/// The least value of a function of the points of an arc.
template <class Function>
double least_on(const AxisArc& arc, const Function& function) {
  const auto value = [&](double t) {
    const PlanePoint p = arc.curve.point_at(t);
    return function(Vec2{p[0], p[1]});
  };
  const auto parameter = [&](int i) { return arc.t[0] + (arc.t[1] - arc.t[0]) * i / kParts; };
  std::array<double, kParts + 1> values;
  for (int i = 0; i <= kParts; ++i) values[static_cast<std::size_t>(i)] = value(parameter(i));
  const auto at = static_cast<int>(std::ranges::min_element(values) - values.begin());
  double low = parameter(std::max(0, at - 1)), high = parameter(std::min(kParts, at + 1));
  for (int i = 0; i < kNarrowings; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (value(a) < value(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return std::min(std::ranges::min(values), value(low));
}

double to_segment(Vec2 x, Vec2 a, Vec2 b) {
  const double share = std::clamp(plane::dot(x - a, b - a) / plane::dot(b - a, b - a), 0.0, 1.0);
  return plane::distance(x, a + share * (b - a));
}

}  // namespace

double distance_to_axis(const PlaneAxis& axis, PlanePoint x) {
  const Vec2 at = {x[0], x[1]};
  double least = std::numeric_limits<double>::infinity();
  for (const AxisArc& arc : axis.arcs) {
    least = std::min(least, least_on(arc, [&](Vec2 y) { return plane::distance(at, y); }));
  }
  return least;
}

bool crosses_axis(const PlaneAxis& axis, PlanePoint a, PlanePoint b) {
  const Vec2 from = {a[0], a[1]}, to = {b[0], b[1]};
  return std::ranges::any_of(axis.arcs, [&](const AxisArc& arc) {
    return least_on(arc, [&](Vec2 y) { return to_segment(y, from, to); }) <= kNear;
  });
}

}  // namespace medial_vk::test
