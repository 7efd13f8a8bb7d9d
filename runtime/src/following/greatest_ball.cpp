#include "following/greatest_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace medial_vk {

double radius_through(const Point& at, const Point& towards_centre, const Point& other) {
  const Point w = other - at;
  const double along = dot(towards_centre, w);
  return along > 0 ? dot(w, w) / (2 * along) : std::numeric_limits<double>::infinity();
}

double contact_slack(const MovingSurface& surface) {
  return kContactSlack * surface.longest_side() + 4 * surface.rounding();
}

namespace {

/// From a ball of this radius.
TrackedBall shrunk_ball(const MovingSurface& surface, const BallContact& contact, const SurfacePoint& other,
                        double radius) {
  constexpr std::size_t kMostGathered = 64;  // triangles
  constexpr int kMostSteps = 64;             // each but the last shrinks the ball onto another contact; few are needed
  const Point at = surface.at(contact.on);
  const double slack = contact_slack(surface);
  TrackedBall tracked;
  tracked.a = contact;
  tracked.b.on = other;
  double empty = 0;
  Point centre = at + radius * contact.towards_centre;
  // Each ball holds the next ones: they touch at the same point, and the slack is more than the rounding of centres.
  std::array<std::uint32_t, kMostGathered> room;
  const auto gathered = surface.gather(centre, radius, room);
  for (int step = 0; step < kMostSteps; ++step) {
    centre = at + radius * contact.towards_centre;
    const BvhHit nearer =
        gathered ? surface.closest_of(*gathered, centre, radius - slack) : surface.closest(centre, radius - slack);
    if (nearer.triangle == BvhHit().triangle) {
      empty = radius - slack;
      break;
    }
    tracked.b.on = surface.surface_point(nearer);
    empty = std::sqrt(nearer.squared_distance);
    const double next = radius_through(at, contact.towards_centre, nearer.point);
    if (!(next < radius)) break;
    radius = next;
  }
  const double safe = empty - surface.rounding();
  tracked.ball = {centre, safe >= kLeastRadius * surface.longest_side() ? safe : 0};
  if (tracked.ball.radius > 0 && tracked.b.on.is_known()) {
    const Point away = centre - surface.at(tracked.b.on);
    const double size = length(away);
    tracked.b.towards_centre = size > 0 ? (1 / size) * away : contact.towards_centre;
  }
  return tracked;
}

}  // namespace

TrackedBall greatest_ball(const MovingSurface& surface, const BallContact& contact, const SurfacePoint& other) {
  double radius = 0.5 * surface.longest_side();  // no ball inside is larger
  if (other.is_known()) {
    radius = std::min(radius, radius_through(surface.at(contact.on), contact.towards_centre, surface.at(other)));
  }
  return shrunk_ball(surface, contact, other, radius);
}

TrackedBall greatest_ball_up_to(const MovingSurface& surface, const BallContact& contact, const SurfacePoint& other,
                                double most) {
  return shrunk_ball(surface, contact, other, most + contact_slack(surface) + surface.rounding());
}

}  // namespace medial_vk
