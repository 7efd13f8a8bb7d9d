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
  const double reach = balls_.contacts().reach_along(first, balls_.most_reach()).most;
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
  describe(p, out);
  return out;
}

/// The largest ball has a diameter of at most the upper end: where it is between parallel faces, one of the lower end
/// that touches one of them leaves no more than the width to the other. In a round limb three contacts at equal angles
/// prove the upper end; opposite ones are looked up across from the two that are farthest apart.
void LargestBallNear::describe(const Point& p, Thickness& out) {
  out.contacts = {p, p};
  if (!(out.ball.radius > 0)) return;
  const double beyond = balls_.delta() + (out.diameter.upper - out.diameter.lower);
  const auto kind = [&] {
    balls_.collect_contacts(beyond, touched_);
    return kind_of_ball(touched_, options_.wall_angle, options_.crease_angle);
  };
  BallKind found = kind();
  if (found.kind == ThicknessKind::kCrease || found.kind == ThicknessKind::kCorner) {
    for (const BallContact& contact : found.widest) balls_.look_across(contact.normal);
    found = kind();
  }
  out.object_angle = found.object_angle;
  if (!touched_.empty()) out.contacts = {p + found.widest[0].at, p + found.widest[1].at};
  out.kind = found.kind;
}

}  // namespace medial_vk
