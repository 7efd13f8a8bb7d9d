#include "following/ascent.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "following/tangent_rule.h"

namespace medial_vk {
namespace {

// A step that continues in the direction of the last one grows, one that turns back shrinks.
constexpr double kGrowth = 1.2, kReduction = 0.5;
constexpr double kLeastStep = 1e-4, kGreatestStep = 0.3;
// The greatest loss of volume by a move, to first order, as a share of the exposed area times the radius. Without any,
// balls come less far (docs/decisions.md).
constexpr double kMostLoss = 1e-3;

/// Moving the centre by d while the ball stays tangent to both contacts lets the radius grow by -u . d, with u from the
/// centre to either contact, if d is perpendicular to the difference m of both: the change of the volume is
/// area (vector / area - u) . d, to first order.
Point ascent_direction(const TrackedBall& tracked, const Exposure& exposure) {
  const double share = length(exposure.vector) <= exposure.area ? 1 / exposure.area : 0;  // false by rounding only
  const Point gradient = share * exposure.vector + tracked.a.towards_centre;
  const Point across = tracked.a.towards_centre - tracked.b.towards_centre;
  const double squared = dot(across, across);
  return squared > 0 ? gradient - (dot(gradient, across) / squared) * across : gradient;
}

}  // namespace

void ascend(const MovingSurface& surface, const Exposure& exposure, TrackedBall& tracked) {
  if (!(exposure.area > 0) || !tracked.has_two_contacts()) return;
  const Point direction = ascent_direction(tracked, exposure);
  const double factor = dot(direction, tracked.last_direction) > 0 ? kGrowth : kReduction;
  const bool is_first = dot(tracked.last_direction, tracked.last_direction) == 0;
  if (!is_first) tracked.step = std::clamp(factor * tracked.step, kLeastStep, kGreatestStep);
  tracked.last_direction = direction;
  const Point guess = tracked.ball.centre + (tracked.step * tracked.ball.radius) * direction;
  const TrackedBall moved = greatest_ball_at(surface, guess, tracked.a.on, tracked.b.on);
  if (!(moved.ball.radius > 0)) return;
  // Where the two contacts are neighbours on a circle of contacts, the greatest ball at the guess may be a smaller one.
  const double grown = moved.ball.radius - tracked.ball.radius;
  const double gain = exposure.area * grown + dot(exposure.vector, moved.ball.centre - tracked.ball.centre);
  if (gain < -kMostLoss * exposure.area * tracked.ball.radius) {
    tracked.step = std::max(kReduction * tracked.step, kLeastStep);
    return;
  }
  tracked.ball = moved.ball;
  tracked.a = moved.a;
  tracked.b = moved.b;
}

}  // namespace medial_vk
