#include "thickness/largest_ball_near.h"

#include <algorithm>

namespace medial_vk {
namespace {

// The first ball on the other side is this many deltas away: large enough to hold points of most directions there.
constexpr double kOutward = 64;

/// The direction of a sum of a unit vector and a difference of two; the unit vector where they nearly cancel.
Point leaning(const Point& direction, const Point& lean) {
  constexpr double kLeastSize = 0.1;
  const Point sum = direction + lean;
  const double size = length(sum);
  return size > kLeastSize ? (1 / size) * sum : direction;
}

}  // namespace

Thickness LargestBallNear::find(const Point& p, const Point& inward) {
  balls_.start(p);
  const Point first = leaning(inward, lean_);
  const double reach = balls_.contacts().reach_along(first, balls_.slack(), balls_.most_reach()).most;
  balls_.probe(first, reach);
  balls_.probe_at(-1.0 * inward, std::min(kOutward * balls_.delta(), balls_.limit()));
  facets_.run(CubeFrame::around(inward));
  cells_.start();
  for (const FacetSearch::OpenTriangle& open : facets_.open()) cells_.add(DirectionCell(open.corners), open.reach);
  const double left = cells_.run();
  const double upper = std::max(balls_.target(), left > 0 ? left + balls_.off() : 0);
  balls_.keep_used();
  Thickness out;
  const Ball& best = balls_.best();
  const double distance = length(best.centre);
  lean_ = distance > 0 ? (1 / distance) * best.centre - inward : Point{0, 0, 0};
  out.diameter = {2 * best.radius, 2 * std::max(best.radius, std::min(upper, balls_.limit()))};
  out.ball = {p + best.centre, best.radius};
  out.object_angle = balls_.object_angle();
  return out;
}

}  // namespace medial_vk
