#include "cpu_reference/plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::reference {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

struct Touch {
  double radius = std::numeric_limits<double>::infinity();
  Vector2d at = {0, 0};
};

/// The disc that touches p, with its centre on the ray along n, and the point c.
void touch_point(const Vector2d& p, const Vector2d& n, const Vector2d& c, Touch& touch) {
  const double ahead = n.dot(c - p);
  if (!(ahead > 0)) return;
  const double radius = (c - p).squaredNorm() / (2 * ahead);
  if (radius < touch.radius) touch = {radius, c};
}

/// The same with the line of a segment, where it touches that between the ends.
void touch_line(const Vector2d& p, const Vector2d& n, const std::array<Vector2d, 2>& segment, Touch& touch) {
  const auto& [a, b] = segment;
  const double length = (b - a).norm();
  const Vector2d along = (b - a) / length;
  const Vector2d normal(-along[1], along[0]);
  const double height = normal.dot(p - a), rate = normal.dot(n);
  for (const double side : {1.0, -1.0}) {
    // The centre p + r n is at height side * r.
    const double radius = height / (side - rate);
    if (!(radius > 0) || !(radius < touch.radius)) continue;
    const double foot = along.dot(p + radius * n - a);
    if (foot >= 0 && foot <= length) touch = {radius, a + foot * along};
  }
}

}  // namespace

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double square = (b - a).squaredNorm();
  const double along = square > 0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0;
  if (along <= 0) return (p - a).norm();
  if (along >= 1) return (p - b).norm();
  return std::fabs(cross(b - a, p - a)) / std::sqrt(square);
}

double distance_to_segments(const Vector2d& p, const PlaneSegments& segments) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : segments) least = std::min(least, distance_to_segment(p, a, b));
  return least;
}

bool is_inside(const Vector2d& p, const PlaneSegments& segments) {
  int winding = 0;
  for (const auto& [a, b] : segments) {
    if ((a[1] <= p[1]) == (b[1] <= p[1])) continue;
    const bool upwards = a[1] <= p[1];
    if ((cross(b - a, p - a) > 0) == upwards) winding += upwards ? 1 : -1;
  }
  return winding != 0;
}

std::optional<PlaneBall> greatest_disc(const Vector2d& p, const Vector2d& n, std::size_t own,
                                       const PlaneSegments& segments) {
  Touch touch;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (s == own) continue;
    for (const Vector2d& end : segments[s]) touch_point(p, n, end, touch);
    touch_line(p, n, segments[s], touch);
  }
  if (!std::isfinite(touch.radius)) return std::nullopt;
  const Vector2d centre = p + touch.radius * n, other = touch.at - centre;
  return PlaneBall{centre, touch.radius, std::atan2(std::fabs(cross(-n, other)), -n.dot(other)) / 2};
}

}  // namespace medial_vk::reference
