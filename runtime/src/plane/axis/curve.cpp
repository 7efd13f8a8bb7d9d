#include <algorithm>
#include <cmath>

#include "medial_vk/plane_axis.h"

namespace medial_vk {

PlanePoint PlaneCurve::point_at(double t) const {
  const double rise = kind == Kind::kOfPointAndSegment ? radius_at(t) : 0;
  return {origin[0] + t * along[0] + rise * up[0], origin[1] + t * along[1] + rise * up[1]};
}

double PlaneCurve::radius_at(double t) const {
  switch (kind) {
    case Kind::kOfPoints:
      return std::hypot(focus, t);
    case Kind::kOfPointAndSegment:
      return t * (t / (2 * focus)) + focus / 2;
    case Kind::kOfSegments:
      break;
  }
  return std::max(0.0, radius + slope * t);
}

double PlaneCurve::object_angle_at(double t) const {
  return kind == Kind::kOfSegments ? angle : std::atan2(focus, std::fabs(t));
}

/// Of a parabola: the integral of sqrt(1 + (t / focus)^2).
double PlaneCurve::length(double from, double to) const {
  if (kind != Kind::kOfPointAndSegment) return std::fabs(to - from);
  const auto integral = [&](double t) { return (t * std::hypot(1, t / focus) + focus * std::asinh(t / focus)) / 2; };
  return std::fabs(integral(to) - integral(from));
}

std::uint64_t PlaneAxis::junctions() const {
  return static_cast<std::uint64_t>(std::ranges::count_if(nodes, [](const AxisNode& n) { return n.degree >= 3; }));
}

}  // namespace medial_vk
