#include "medial_vk/proximity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "proximity/body.h"
#include "proximity/closest_balls.h"

namespace medial_vk {
namespace {

constexpr double kLargest = 1e18;  // of a coordinate

Status check(std::span<const Ball> balls, const char* set) {
  if (balls.size() > kMostBodyBalls) {
    return Error{ErrorCode::kUsage, fmt::format("{} has {} balls, more than {}", set, balls.size(), kMostBodyBalls)};
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [centre, radius] = balls[i];
    bool is_good = radius >= 0 && radius <= kLargest;
    for (const double x : centre) is_good = is_good && std::fabs(x) + radius <= kLargest;
    if (is_good) continue;
    return Error{
        ErrorCode::kUsage,
        fmt::format("ball {} of {} is not finite, has a negative radius or reaches beyond {:g}", i, set, kLargest)};
  }
  return {};
}

/// The middle of the box around all centres.
Point middle_of(std::span<const Ball> inside, std::span<const Ball> cover) {
  Point lower = inside.empty() ? cover.front().centre : inside.front().centre, upper = lower;
  for (const std::span<const Ball> balls : {inside, cover}) {
    for (const Ball& ball : balls) {
      lower = least(lower, ball.centre);
      upper = greatest(upper, ball.centre);
    }
  }
  return 0.5 * (lower + upper);
}

/// A pose with what the searches in two pairs of trees share.
class Between {
 public:
  Between(const BodyImpl& a, const BodyImpl& b, const Pose& pose)
      : a_(a),
        b_(b),
        pose_(pose),
        shift_(pose * b.centre - a.centre),
        distance_(length(shift_)),
        lengths_(length(a.centre) + length(b.centre) + length(pose.shift)),
        float_pose_(is_in_range() ? Pose{pose.rotation, shift_} : Pose{}) {}

  /// False where squares of lengths may be too large for float. With numbers up to kLargest each of three vectors is
  /// shorter than 2 kLargest. A body reaches by less than 4 kLargest from its centre, so no two of its points and those
  /// of the other one are farther apart than 14 kLargest, and (14e18)^2 is a float.
  bool is_in_range() const { return distance_ <= 6 * kLargest && lengths_ <= 6 * kLargest; }

  /// No two balls of the trees are closer; `pair` becomes the closest, and is where the search starts.
  double lower_bound(const BodyTree& a, const BodyTree& b, BallPair& pair) const {
    const ClosestBalls found = closest_balls(a, b, float_pose_, pair, 0.0f);
    pair = found.balls;
    return std::max(0.0, (found.separation - separation_error(a, b, distance_) - 0x1p-48 * lengths_) * (1 - 0x1p-50));
  }

  /// Two balls of the sets are as close; `pair` as above. The search may end at two that overlap by more than all
  /// errors.
  double upper_bound(const BodyTree& a, const BodyTree& b, BallPair& pair) const {
    const double error = separation_error(a, b, distance_);
    pair = closest_balls(a, b, float_pose_, pair, static_cast<float>(-4 * error - 0x1p-46 * lengths_)).balls;
    const Ball &ball_a = a_.inside[pair.a], &ball_b = b_.inside[pair.b];
    const Point away = ball_a.centre - pose_ * ball_b.centre;
    // Eleven roundings of sums of at most this; a rotation that is one to within 1e-12 may also shrink the ball.
    const double size = length(ball_a.centre) + length(ball_b.centre) + length(pose_.shift) + ball_a.radius;
    const double separation = std::hypot(away[0], away[1], away[2]) - ball_a.radius - ball_b.radius;  // no underflow
    return std::max(0.0, separation + 0x1p-48 * size + 4e-12 * ball_b.radius);
  }

 private:
  const BodyImpl& a_;
  const BodyImpl& b_;
  const Pose& pose_;
  Point shift_;  // of the centre of b from that of a
  double distance_;
  double lengths_;  // bounds all lengths in double, whose errors are small shares of it
  FloatPose float_pose_;
};

}  // namespace

Result<Body> Body::create(std::span<const Ball> inside, std::span<const Ball> cover) {
  if (inside.empty() && cover.empty()) return Error{ErrorCode::kUsage, "a body needs balls `inside` or a `cover`"};
  if (Status status = check(inside, "`inside`"); !status) return status.error();
  if (Status status = check(cover, "`cover`"); !status) return status.error();
  return catch_out_of_memory("indexing the balls of a body", [&]() -> Result<Body> {
    const auto impl = std::make_shared<Impl>();
    impl->centre = middle_of(inside, cover);
    impl->inside.assign(inside.begin(), inside.end());
    impl->cover.assign(cover.begin(), cover.end());
    impl->inside_tree = BodyTree::build(inside, impl->centre);
    impl->cover_tree = BodyTree::build(cover, impl->centre);
    return Body(impl);
  });
}

std::span<const Ball> Body::inside() const { return impl_->inside; }
std::span<const Ball> Body::cover() const { return impl_->cover; }

DistanceBounds distance_bounds(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& start) {
  const BodyImpl &in_a = Internals::of(a), &in_b = Internals::of(b);
  const Between between(in_a, in_b, pose);
  DistanceBounds bounds;
  if (!between.is_in_range()) return bounds;
  if (!in_a.cover_tree.is_empty() && !in_b.cover_tree.is_empty()) {
    bounds.cover_pair = start.cover_pair;
    bounds.lower = between.lower_bound(in_a.cover_tree, in_b.cover_tree, bounds.cover_pair);
  }
  if (!in_a.inside_tree.is_empty() && !in_b.inside_tree.is_empty()) {
    bounds.inside_pair = start.inside_pair;
    bounds.upper = between.upper_bound(in_a.inside_tree, in_b.inside_tree, bounds.inside_pair);
  }
  return bounds;
}

void distance_bounds(const Body& a, const Body& b, std::span<const Pose> poses, std::span<DistanceBounds> bounds,
                     const DistanceOptions& options) {
  constexpr std::size_t kBlock = 256;
  parallel_blocks(poses.size(), kBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bounds[i] = distance_bounds(a, b, poses[i], i > begin ? bounds[i - 1] : DistanceBounds{});
    }
  });
}

}  // namespace medial_vk
