#include "following/tangent_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "following/greatest_ball.h"

namespace medial_vk {
namespace {

// Below this object angle (radians) or share of its last radius, a ball is tried between both contacts, too.
constexpr double kFlatAngle = 0.42;
constexpr double kShrunk = 0.8;

// By which a distance relative to the radius, and the cosine of the angle between the spokes, may have changed.
constexpr double kNoLongerRest = 0.001;
constexpr double kAtRest = 1 - 1e-6;

BallContact carried(const MovingSurface& surface, const BallContact& contact) {
  return {contact.on, surface.carried(contact.towards_centre, contact.on)};
}

/// From the point that lies as far from both contacts along their directions, in the mean.
TrackedBall ball_between(const MovingSurface& surface, const BallContact& a, const BallContact& b) {
  const Point at_a = surface.at(a.on), at_b = surface.at(b.on);
  const Point turn = a.towards_centre - b.towards_centre;
  const double squared_turn = dot(turn, turn);
  if (!(squared_turn > 0)) return {};
  const double along = dot(at_b - at_a, turn) / squared_turn;
  if (!(along > 0)) return {};
  const Point guess = 0.5 * ((at_a + along * a.towards_centre) + (at_b + along * b.towards_centre));
  return greatest_ball_at(surface, guess, a.on, b.on);
}

/// Infinite where the point is not known.
double squared_distance(const MovingSurface& surface, const Point& from, const SurfacePoint& to) {
  if (!to.is_known()) return std::numeric_limits<double>::infinity();
  const Point between = surface.at(to) - from;
  return dot(between, between);
}

/// The surface is nearer than this to `guess`: one of both points lies on it, up to rounding.
double bound_of_distance(const MovingSurface& surface, const Point& guess, const SurfacePoint& a,
                         const SurfacePoint& b) {
  const double squared = std::min(squared_distance(surface, guess, a), squared_distance(surface, guess, b));
  return (1 + 0x1p-40) * std::sqrt(squared) + 4 * surface.rounding();
}

}  // namespace

TrackedBall greatest_ball_at(const MovingSurface& surface, const Point& guess, const SurfacePoint& a,
                             const SurfacePoint& b) {
  const BvhHit nearest = surface.closest(guess, bound_of_distance(surface, guess, a, b));
  if (nearest.triangle == BvhHit().triangle) return {};  // the guess is no number
  const double distance = std::sqrt(nearest.squared_distance);
  if (!(distance > 2 * surface.rounding())) return {};
  const BallContact contact = {surface.surface_point(nearest), (1 / distance) * (guess - nearest.point)};
  if (!(dot(contact.towards_centre, surface.inward_normal(nearest.triangle)) > 0)) return {};
  // The nearest point may be next to one of both, and then says nothing of the radius together with that one.
  const bool is_next_to_b = a.is_known() && (!b.is_known() || squared_distance(surface, nearest.point, a) >
                                                                  squared_distance(surface, nearest.point, b));
  const TrackedBall ball = greatest_ball(surface, contact, is_next_to_b ? a : b);
  return ball.ball.radius > 0 ? ball : TrackedBall{};
}

double share_of_rest(const MovingSurface& surface, const TrackedBall& rest) {
  if (!rest.has_two_contacts()) return 0;
  const double rest_radius =
      radius_through(surface.at_rest(rest.a.on), rest.a.towards_centre, surface.at_rest(rest.b.on));
  const Point to_a = surface.carried_from_rest(rest.a.towards_centre, rest.a.on);
  const Point to_b = surface.carried_from_rest(rest.b.towards_centre, rest.b.on);
  const double radius = radius_through(surface.at(rest.a.on), to_a, surface.at(rest.b.on));
  const double turn = dot(to_a, to_b) - dot(rest.a.towards_centre, rest.b.towards_centre);
  const double change = std::fabs(radius / rest_radius - 1) + std::fabs(turn);
  return change < kNoLongerRest ? 1 - change / kNoLongerRest : 0;  // not for a change that is no number
}

TrackedBall drawn_to_rest(const MovingSurface& surface, const TrackedBall& rest, double share,
                          const TrackedBall& followed) {
  if (share <= 0) return followed;
  const BallContact contact = {rest.a.on, surface.carried_from_rest(rest.a.towards_centre, rest.a.on)};
  const bool is_at_rest = share > kAtRest;
  // Where contacts are next to each other, the second one bounds the radius with a large rounding error.
  const TrackedBall image = is_at_rest ? greatest_ball_up_to(surface, contact, rest.b.on, rest.ball.radius)
                                       : greatest_ball(surface, contact, rest.b.on);
  const bool is_whole = image.ball.radius >= (1 - kNoLongerRest) * rest.ball.radius;  // nothing else has come near
  if (!is_whole) return followed;
  if (is_at_rest || !(followed.ball.radius > 0)) return image;
  const Point guess = followed.ball.centre + share * (image.ball.centre - followed.ball.centre);
  const TrackedBall mixed = greatest_ball_at(surface, guess, followed.a.on, followed.b.on);
  return mixed.ball.radius > 0 ? mixed : followed;
}

TrackedBall follow_tangent(const MovingSurface& surface, const TrackedBall& last) {
  BallContact a = carried(surface, last.a);
  if (!last.b.on.is_known()) return greatest_ball(surface, a, last.b.on);
  BallContact b = carried(surface, last.b);
  // The direction at a contact within a face is the normal of that face.
  if (!a.on.is_within_face() && b.on.is_within_face()) std::swap(a, b);
  TrackedBall now = greatest_ball(surface, a, b.on);
  if (now.object_angle() < kFlatAngle || now.ball.radius < kShrunk * last.ball.radius) {
    const TrackedBall between = ball_between(surface, a, b);
    if (between.ball.radius > now.ball.radius) now = between;
  }
  if (!(now.ball.radius > 0)) return {now.ball, a, b};
  return now;
}

TrackedBall recovered_ball(const MovingSurface& surface, const TrackedBall& lost) {
  for (const BallContact& contact : {lost.a, lost.b}) {
    if (!contact.on.is_known()) continue;
    const BallContact straight = {contact.on, surface.inward_normal(contact.on.triangle)};
    const TrackedBall ball = greatest_ball(surface, straight, {});
    if (ball.ball.radius > 0 && surface.holds(ball.ball)) return ball;
  }
  return lost;
}

}  // namespace medial_vk
