#include "sphere_fits/steps/maximal_ball.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "bvh/triangle_distance.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = BvhHit().triangle;

/// The nearest point of these triangles, if one is closer than `bound`.
BvhHit closest_of(const Solid& solid, const Point& p, std::span<const std::uint32_t> triangles, double bound) {
  const Mesh& mesh = solid.mesh().mesh;
  BvhHit closest;
  double least = bound * bound;
  for (const std::uint32_t triangle : triangles) {
    const auto [a, b, c] = mesh.triangles[triangle];
    const NearestOffset here = nearest_on_triangle(p, {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    if (!(here.squared_distance < least)) continue;
    least = here.squared_distance;
    closest = {least, p + here.offset, triangle};
  }
  return closest;
}

/// A point of the boundary that is closer than `bound`: the closest one of these triangles, or that of the boundary,
/// whose triangle is appended.
BvhHit closer_point(const Solid& solid, const Point& p, std::vector<std::uint32_t>& triangles, double bound) {
  const BvhHit known = closest_of(solid, p, triangles, bound);
  if (known.triangle != kNone) return known;
  const BvhHit closest = solid.closest(p, bound);
  if (closest.triangle != kNone) triangles.push_back(closest.triangle);
  return closest;
}

}  // namespace

BvhHit closest_with(const Solid& solid, const Point& p, std::span<const std::uint32_t> triangles) {
  const BvhHit known = closest_of(solid, p, triangles, HUGE_VAL);
  const BvhHit closer = solid.closest(p, std::sqrt(known.squared_distance));
  return closer.triangle == kNone ? known : closer;
}

Ball maximal_ball(const Solid& solid, const Point& inside) {
  std::vector<std::uint32_t> triangles;
  return maximal_ball(solid, inside, triangles);
}

Ball maximal_ball(const Solid& solid, const Point& inside, std::vector<std::uint32_t>& triangles) {
  constexpr int kMostSteps = 256;  // each but the last shrinks the ball onto another point; few are needed
  const BvhHit contact = closest_with(solid, inside, triangles);
  const double distance = std::sqrt(contact.squared_distance);
  const Ball around = {inside, distance - solid.rounding()};
  if (around.radius <= 0) return around;
  if (std::find(triangles.begin(), triangles.end(), contact.triangle) == triangles.end())
    triangles.push_back(contact.triangle);
  const Point away = (1 / distance) * (inside - contact.point);
  double radius = solid.diagonal();
  for (int step = 0; step < kMostSteps; ++step) {
    const Point centre = contact.point + radius * away;
    // Points that are nearer than the contact by rounding only are the contact.
    const BvhHit nearer = closer_point(solid, centre, triangles, radius - 4 * solid.rounding());
    if (nearer.triangle == kNone) {
      const double least = std::sqrt(closest_with(solid, centre, triangles).squared_distance);
      const Ball ball = {centre, std::min(radius, least) - solid.rounding()};
      // The boundary does not meet this ball, so it is in the solid if it holds the point. In a thin part, the
      // direction away from the contact is so inexact that it may not; lengths have relative errors of a few 2^-53.
      return length(centre - inside) * (1 + 0x1p-48) < ball.radius ? ball : around;
    }
    // The ball through the contact and that point: |w - R u| = R.
    const Point w = nearer.point - contact.point;
    const double along = dot(away, w);
    const double next = along > 0 ? dot(w, w) / (2 * along) : distance;
    if (!(next > distance) || !(next < radius)) break;
    radius = next;
  }
  return around;
}

}  // namespace medial_vk
