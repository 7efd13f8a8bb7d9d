#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "proximity/closest_balls.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

constexpr std::size_t kBlock = 256;  // poses that one thread takes at a time
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// No separation in float below this is less than `most`, whose errors are up to `error`.
float in_float(double most, double error) { return most < kFarther ? rounded_up(most + error) : kFarther; }

double length_without_underflow(const Point& p) {
  const double squared = dot(p, p);
  return squared > 1e-280 ? std::sqrt(squared) : std::hypot(p[0], p[1], p[2]);
}

}  // namespace

double lower_bound(const BodyTree& a, const BodyTree& b, const Placement& placement, double most, BallPair& pair) {
  const double error = placement.separation_error_of(a.nodes(), b.nodes());
  const ClosestBalls found = closest_balls(a, b, placement.float_pose(), pair, 0.0f, in_float(most, error));
  if (found.balls == BallPair{}) return most;
  pair = found.balls;
  return std::min(most, std::max(0.0, (found.separation - error) * (1 - 0x1p-50)));
}

/// The search may end at two balls that overlap by more than all errors.
double upper_bound(const BodyImpl& a, const BodyImpl& b, const Placement& placement, double most, BallPair& pair) {
  const BodyTree &tree_a = a.inside_tree, &tree_b = b.inside_tree;
  const double error = placement.separation_error_of(tree_a.nodes(), tree_b.nodes());
  const ClosestBalls found = closest_balls(tree_a, tree_b, placement.float_pose(), pair, static_cast<float>(-4 * error),
                                           in_float(most, error));
  if (found.balls == BallPair{}) return most;
  const Ball &ball_a = a.inside[found.balls.a], &ball_b = b.inside[found.balls.b];
  const Point away = ball_a.centre - placement.pose() * ball_b.centre;
  // Eleven roundings of sums of at most this; a rotation that is one to within 1e-12 may also shrink the ball.
  const double size = length(ball_a.centre) + length(ball_b.centre) + length(placement.pose().shift) + ball_a.radius;
  const double separation = length_without_underflow(away) - ball_a.radius - ball_b.radius;
  const double bound = std::max(0.0, separation + 0x1p-48 * size + 4e-12 * ball_b.radius + placement.error());
  if (!(bound < most)) return most;
  pair = found.balls;
  return bound;
}

DistanceBounds distance_bounds(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& start) {
  const BodyImpl &in_a = Internals::of(a), &in_b = Internals::of(b);
  const Placement placement(in_a, in_b, pose);
  DistanceBounds bounds;
  if (!placement.is_in_range()) return bounds;
  if (!in_a.cover_tree.is_empty() && !in_b.cover_tree.is_empty()) {
    bounds.cover_pair = start.cover_pair;
    bounds.lower = lower_bound(in_a.cover_tree, in_b.cover_tree, placement, kUnbounded, bounds.cover_pair);
  }
  if (!in_a.inside_tree.is_empty() && !in_b.inside_tree.is_empty()) {
    bounds.inside_pair = start.inside_pair;
    // Where the covers are apart, the closest balls inside are near the closest ones of the covers.
    if (bounds.inside_pair == BallPair{} && bounds.lower > 0 && !(bounds.cover_pair == BallPair{})) {
      bounds.inside_pair =
          balls_near(in_a.inside_tree, in_b.inside_tree, placement.float_pose(),
                     in_a.cover_tree.leaf(bounds.cover_pair.a), in_b.cover_tree.leaf(bounds.cover_pair.b));
    }
    bounds.upper = upper_bound(in_a, in_b, placement, kUnbounded, bounds.inside_pair);
  }
  return bounds;
}

double estimated_distance(const Body& a, const Body& b, const DistanceBounds& bounds) {
  if (!(bounds.upper < kUnbounded)) return bounds.lower;
  const MeanErrors &of_a = Internals::of(a).errors, &of_b = Internals::of(b).errors;
  const auto error = [](const std::vector<float>& errors, std::uint32_t ball) {
    return ball < errors.size() ? static_cast<double>(errors[ball]) : 0.0;
  };
  const BallPair &cover = bounds.cover_pair, &inside = bounds.inside_pair;
  const double below = error(of_a.cover, cover.a) + error(of_b.cover, cover.b);
  const double above = error(of_a.inside, inside.a) + error(of_b.inside, inside.b);
  const double share = below + above > 0 ? below / (below + above) : 0.5;
  return std::clamp(bounds.lower + share * (bounds.upper - bounds.lower), bounds.lower, bounds.upper);
}

void distance_bounds(const Body& a, const Body& b, std::span<const Pose> poses, std::span<DistanceBounds> bounds,
                     const BatchOptions& options) {
  parallel_blocks(poses.size(), kBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bounds[i] = distance_bounds(a, b, poses[i], i > begin ? bounds[i - 1] : DistanceBounds{});
    }
  });
}

void distance_bounds(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<DistanceBounds> bounds,
                     const BatchOptions& options) {
  parallel_for(pairs.size(), kBlock, options.threads, [&](std::size_t i) {
    const auto& [pose, a, b] = pairs[i];
    bounds[i] = distance_bounds(bodies[a], bodies[b], pose);
  });
}

}  // namespace medial_vk
