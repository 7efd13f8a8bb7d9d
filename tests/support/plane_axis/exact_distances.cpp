#include "support/plane_axis/exact_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::test {
namespace {

double apart(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

PlanePoint foot_on(const PlanePoint& a, const PlanePoint& b, const PlanePoint& x) {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double share = ((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / (dx * dx + dy * dy);
  const double t = std::clamp(share, 0.0, 1.0);
  return {a[0] + t * dx, a[1] + t * dy};
}

/// The angle at x between two feet.
double turn(const PlanePoint& x, const PlanePoint& a, const PlanePoint& b) {
  const double ux = a[0] - x[0], uy = a[1] - x[1], vx = b[0] - x[0], vy = b[1] - x[1];
  return std::fabs(std::atan2(ux * vy - uy * vx, ux * vx + uy * vy));
}

}  // namespace

NearestPoint nearest_point(const PreparedShape& shape, const PlanePoint& x) {
  NearestPoint best = {std::numeric_limits<double>::infinity(), {}};
  for (const auto& [a, b] : shape.segments) {
    const PlanePoint foot = foot_on(shape.points[a], shape.points[b], x);
    const double d = apart(x, foot);
    if (d < best.distance) best = {d, foot};
  }
  return best;
}

bool is_inside(const PreparedShape& shape, const PlanePoint& x) {
  int winding = 0;
  for (const auto& [from, to] : shape.segments) {
    const PlanePoint &a = shape.points[from], &b = shape.points[to];
    const bool is_up = a[1] <= x[1] && b[1] > x[1], is_down = b[1] <= x[1] && a[1] > x[1];
    if (!is_up && !is_down) continue;
    const double side = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
    winding += is_up && side > 0 ? 1 : is_down && side < 0 ? -1 : 0;
  }
  return winding != 0;
}

double distance_to_axis(const PlaneAxis& axis, const PlanePoint& x) {
  double best = std::numeric_limits<double>::infinity();
  for (const AxisNode& node : axis.nodes) best = std::min(best, apart(node.point, x));
  for (const AxisArc& arc : axis.arcs) {
    constexpr int kSteps = 24;
    const double step = (arc.t[1] - arc.t[0]) / kSteps;
    double nearest = arc.t[0], least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
      const double t = arc.t[0] + i * step, d = apart(arc.curve.point_at(t), x);
      if (d < least) nearest = t;
      least = std::min(least, d);
    }
    double low = std::max(arc.t[0], nearest - step), high = std::min(arc.t[1], nearest + step);
    for (int i = 0; i < 80; ++i) {
      const double a = low + (high - low) * 0.382, b = low + (high - low) * 0.618;
      (apart(arc.curve.point_at(a), x) < apart(arc.curve.point_at(b), x) ? high : low) =
          apart(arc.curve.point_at(a), x) < apart(arc.curve.point_at(b), x) ? b : a;
    }
    best = std::min({best, least, apart(arc.curve.point_at((low + high) / 2), x)});
  }
  return best;
}

std::optional<AxisSample> axis_sample(const PreparedShape& shape, PlaneSide side, std::mt19937_64& random) {
  std::uniform_real_distribution<> share(0, 1);
  const ShapeReport& report = shape.report;
  const double length = 0.02 * report.longest_side(), way = 6.3 * share(random);
  PlanePoint a;
  for (std::size_t k = 0; k < 2; ++k) a[k] = report.lower[k] + share(random) * (report.upper[k] - report.lower[k]);
  PlanePoint b = {a[0] + length * std::cos(way), a[1] + length * std::sin(way)};
  const bool wants_inside = side == PlaneSide::kInside;
  NearestPoint at_a = nearest_point(shape, a), at_b = nearest_point(shape, b);
  if (at_a.distance < length || is_inside(shape, a) != wants_inside) return {};
  for (int i = 0; i < 90; ++i) {
    const PlanePoint middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    const NearestPoint at_middle = nearest_point(shape, middle);
    const bool turns_first = turn(middle, at_middle.foot, at_a.foot) > turn(middle, at_middle.foot, at_b.foot);
    (turns_first ? b : a) = middle;
    (turns_first ? at_b : at_a) = at_middle;
  }
  return AxisSample{a, at_a.distance, turn(a, at_a.foot, at_b.foot) / 2};
}

}  // namespace medial_vk::test
