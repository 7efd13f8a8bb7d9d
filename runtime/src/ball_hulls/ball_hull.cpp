#include "medial_vk/ball_hull.h"

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"

namespace medial_vk {

std::size_t parameters_of(HullKind kind) {
  switch (kind) {
    case HullKind::kBall:
      return 4;
    case HullKind::kCapsule:
      return 7;
    case HullKind::kCone:
      return 8;
    case HullKind::kSlab:
      break;
  }
  return 12;
}

BallHull hull_of(const Ball& a) { return {{a, {}, {}}, 1}; }
BallHull hull_of(const Ball& a, const Ball& b) { return {{a, b, {}}, 2}; }
BallHull hull_of(const Ball& a, const Ball& b, const Ball& c) { return {{a, b, c}, 3}; }

HullKind kind_of(const BallHull& hull) {
  if (hull.count == 1) return HullKind::kBall;
  if (hull.count == 3) return HullKind::kSlab;
  return hull.corners[0].radius == hull.corners[1].radius ? HullKind::kCapsule : HullKind::kCone;
}

double signed_distance(const BallHull& hull, const Point& p) {
  if (hull.count == 1) return length(p - hull.corners[0].centre) - hull.corners[0].radius;
  if (hull.count == 2) return nearest_on_edge(hull, AxisEdge(hull, 0, 1), p).distance;
  const auto edge_of = [&hull](std::size_t k) {
    return AxisEdge(hull, static_cast<std::uint8_t>(k), static_cast<std::uint8_t>((k + 1) % 3));
  };
  return nearest_of_three(hull, AxisFace(hull), edge_of, p).distance;
}

double support(const BallHull& hull, const Point& direction) {
  const double size = length(direction);
  double greatest = dot(hull.corners[0].centre, direction) + size * hull.corners[0].radius;
  for (const Ball& ball : hull.balls().subspan(1)) {
    greatest = std::max(greatest, dot(ball.centre, direction) + size * ball.radius);
  }
  return greatest;
}

Point support_point(const BallHull& hull, const Point& direction) {
  const double size = length(direction);
  Ball found = hull.corners[0];
  double greatest = dot(found.centre, direction) + size * found.radius;
  for (const Ball& ball : hull.balls().subspan(1)) {
    const double reach = dot(ball.centre, direction) + size * ball.radius;
    if (reach <= greatest) continue;
    found = ball;
    greatest = reach;
  }
  return found.centre + (found.radius / size) * direction;
}

HullBounds bounds_of(const BallHull& hull) {
  HullBounds bounds = {hull.corners[0].centre, hull.corners[0].centre};
  for (const Ball& ball : hull.balls()) {
    const Point reach = {ball.radius, ball.radius, ball.radius};
    bounds.lower = least(bounds.lower, ball.centre - reach);
    bounds.upper = greatest(bounds.upper, ball.centre + reach);
  }
  return bounds;
}

}  // namespace medial_vk
