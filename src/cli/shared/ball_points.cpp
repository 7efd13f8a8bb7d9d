#include "cli/shared/ball_points.h"

#include <algorithm>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk::cli {

PointsOfBalls nearest_of_balls(const Ball& a, const Ball& b) {
  const Point away = b.centre - a.centre;
  const double between = length(away);
  const Point towards = between > 0 ? (1 / between) * away : Point{1, 0, 0};
  if (between > a.radius + b.radius) return {a.centre + a.radius * towards, b.centre - b.radius * towards};
  const double step = std::clamp(between - b.radius, 0.0, a.radius);
  const Point common = a.centre + step * towards;
  return {common, common};
}

Distance distance_by_balls(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& bounds) {
  Distance distance;
  distance.lower = bounds.lower;
  distance.upper = bounds.upper;
  const BallPair& pair = bounds.inside_pair;
  if (pair.a == BallPair::kNone) {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    distance.on_a = distance.on_b = {kNothing, kNothing, kNothing};
    return distance;
  }
  const Ball& of_b = b.inside()[pair.b];
  const PointsOfBalls points = nearest_of_balls(a.inside()[pair.a], {pose * of_b.centre, of_b.radius});
  distance.on_a = points.on_a;
  distance.on_b = points.on_b;
  if (bounds.upper == 0) distance.inside_pair = pair;
  return distance;
}

}  // namespace medial_vk::cli
