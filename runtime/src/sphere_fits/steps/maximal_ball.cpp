#include "sphere_fits/steps/maximal_ball.h"

#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {

Ball maximal_ball(const Solid& solid, const Point& inside) {
  constexpr int kMostSteps = 64;  // each but the last shrinks the ball onto another contact; few are needed
  const BvhHit contact = solid.closest(inside);
  const double distance = std::sqrt(contact.squared_distance);
  const Ball around = {inside, distance - solid.rounding()};
  if (around.radius <= 0) return around;
  const Point away = (1 / distance) * (inside - contact.point);
  double radius = solid.diagonal();
  for (int step = 0; step < kMostSteps; ++step) {
    const Point centre = contact.point + radius * away;
    // Points that are nearer than the contact by rounding only are the contact.
    const BvhHit nearer = solid.bvh().closest(centre, radius - 4 * solid.rounding());
    if (nearer.triangle == BvhHit().triangle) {
      const Ball ball = {centre, std::min(radius, solid.distance(centre)) - solid.rounding()};
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
