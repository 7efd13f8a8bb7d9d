#include "thickness/ball_kind.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Between unit vectors; accurate near 0 and pi, too, where the arc cosine is not.
double angle_between(const Point& a, const Point& b) { return 2 * std::atan2(length(a - b), length(a + b)); }

}  // namespace

BallKind kind_of_ball(std::span<const BallContact> contacts, double wall_angle, double crease_angle) {
  if (contacts.empty()) return {};
  const BallContact *a = contacts.data(), *b = a;
  double least_cosine = 2;
  for (const BallContact& one : contacts) {
    for (const BallContact* other = contacts.data(); other != &one; ++other) {
      const double cosine = dot(one.normal, other->normal);
      if (cosine >= least_cosine) continue;
      least_cosine = cosine;
      a = other;
      b = &one;
    }
  }
  BallKind found = {0.5 * angle_between(a->normal, b->normal), {*a, *b}, ThicknessKind::kFacets};
  if (found.object_angle >= wall_angle) {
    found.kind = ThicknessKind::kWall;
  } else if (found.object_angle >= crease_angle && found.object_angle > 0) {
    const Point across = cross(a->normal, b->normal);
    const double least_product = std::sin(crease_angle) * length(across);
    const bool is_corner = std::ranges::any_of(
        contacts, [&](const BallContact& c) { return std::fabs(dot(c.normal, across)) > least_product; });
    found.kind = is_corner ? ThicknessKind::kCorner : ThicknessKind::kCrease;
  }
  return found;
}

}  // namespace medial_vk
