#include "reference_bridge/plane_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace medial_vk {
namespace {

using Eigen::Vector2d;

/// Of a parabola an upper bound: some steps of Newton's method towards its nearest point.
double distance_of_arc(const AxisArc& arc, const Vector2d& origin, const Vector2d& p) {
  const PlaneCurve& curve = arc.curve;
  const auto placed = [&](const PlanePoint& q) { return Vector2d(Vector2d(q.data()) - origin); };
  const Vector2d along(curve.along.data()), up(curve.up.data());
  const Vector2d off = p - placed(curve.origin);
  double t = std::clamp(off.dot(along), arc.t[0], arc.t[1]);
  double least = (p - placed(curve.point_at(t))).norm();
  if (curve.kind != PlaneCurve::Kind::kOfPointAndSegment) return least;
  for (int i = 0; i < 4; ++i) {
    const double slope = t / curve.focus, rise = off.dot(up) - curve.radius_at(t);
    const double step = (off.dot(along) - t + rise * slope) / (1 + slope * slope);
    t = std::clamp(t + step, arc.t[0], arc.t[1]);
    least = std::min(least, (p - placed(curve.point_at(t))).norm());
  }
  return least;
}

}  // namespace

void PlaneCondition::test(double excess, double allowed, const Vector2d& at) {
  ++line_.tested;
  line_.worst = std::max(line_.worst, excess);
  if (excess <= allowed) return;
  if (line_.failed++ > 0) return;
  line_.first_failure = fmt::format("{}: at ({:.9g}, {:.9g}), by {:.3g}", line_.condition, at[0], at[1], excess);
}

double distance_of_arcs(const PlaneAxis& axis, const Vector2d& origin, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const AxisNode& node : axis.nodes) {
    least = std::min(least, (p - (Vector2d(node.point.data()) - origin)).norm());
  }
  for (const AxisArc& arc : axis.arcs) least = std::min(least, distance_of_arc(arc, origin, p));
  return least;
}

}  // namespace medial_vk
