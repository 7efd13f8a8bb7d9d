#include "following/rest_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "following/greatest_ball.h"

namespace medial_vk {
namespace {

/// Points of the surface touch a ball if they are so many slacks farther from the centre than the nearest one, or less:
/// greatest_ball() ends balls one slack before the surface.
constexpr double kTouching = 2;

/// Contacts at this half angle t leave the radius an error of kTouching slacks / (2 sin^2 t), a millionth of the
/// longest side.
constexpr double kLeastAngle = 0.01;

/// By which such an error may make the ball smaller, as a share of its radius.
constexpr double kLost = 1e-3;

/// Squared distances that differ by less are equal: which contact is farther must not depend on rounding.
constexpr double kFarther = 1 + 1e-9;

struct Touch {
  Point at;
  SurfacePoint on;
  std::array<std::uint32_t, 3> vertices;  // of the triangle, the edge or the vertex that holds the point; in order
};

Touch touch_of(const MovingSurface& surface, const BvhHit& hit) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  Touch touch = {hit.point, surface.surface_point(hit), {kNone, kNone, kNone}};
  const std::array shares = touch.on.shares();
  for (std::size_t k = 0; k < 3; ++k) {
    if (shares[k] > SurfacePoint::kOnSide) touch.vertices[k] = surface.triangles()[hit.triangle][k];
  }
  std::ranges::sort(touch.vertices);
  return touch;
}

const Touch& farthest(std::span<const Touch> touches, const Point& from) {
  const Touch* best = &touches.front();
  double greatest = 0;
  for (const Touch& touch : touches) {
    const double squared = dot(touch.at - from, touch.at - from);
    if (squared > kFarther * greatest) {
      greatest = squared;
      best = &touch;
    }
  }
  return *best;
}

BallContact contact_at(const Point& at, const SurfacePoint& on, const Point& centre) {
  const Point spoke = centre - at;
  return {on, (1 / length(spoke)) * spoke};
}

}  // namespace

TrackedBall ball_with_contacts(const MovingSurface& surface, const Ball& ball) {
  const BvhHit nearest = surface.closest(ball.centre, std::numeric_limits<double>::infinity());
  const double distance = std::sqrt(nearest.squared_distance);
  const std::vector<BvhHit> hits = surface.within(ball.centre, distance + kTouching * contact_slack(surface));
  std::vector<Touch> touches;
  touches.reserve(hits.size());
  for (const BvhHit& hit : hits) touches.push_back(touch_of(surface, hit));
  std::ranges::sort(touches, {}, &Touch::vertices);
  if (!touches.empty()) {
    const Touch& a = farthest(touches, touches.front().at);
    const Touch& b = farthest(touches, a.at);
    const TrackedBall held = greatest_ball(surface, contact_at(a.at, a.on, ball.centre), b.on);
    const bool is_as_large = held.ball.radius >= (1 - kLost) * distance;
    if (is_as_large && held.object_angle() >= kLeastAngle) return held;
  }
  return greatest_ball(surface, contact_at(nearest.point, surface.surface_point(nearest), ball.centre), {});
}

}  // namespace medial_vk
