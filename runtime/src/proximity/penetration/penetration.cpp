#include "medial_vk/penetration.h"

#include <algorithm>
#include <cmath>

#include "base/host_memory.h"
#include "proximity/penetration/common_volume.h"
#include "proximity/penetration/depth_bound.h"
#include "proximity/penetration/way_out.h"
#include "proximity/placed/placed_balls.h"

namespace medial_vk {
namespace {

Status check(const PenetrationOptions& options) {
  constexpr std::uint32_t kMostDirections = 1u << 20;
  if (options.directions < 1 || options.directions > kMostDirections) {
    return Error{ErrorCode::kUsage, "`directions` must be from 1 to 1048576"};
  }
  if (!(options.volume_tolerance >= 0 && options.volume_tolerance <= 1)) {
    return Error{ErrorCode::kUsage, "`volume_tolerance` must be from 0 to 1"};
  }
  return {};
}

/// Two sets of balls of the two bodies, placed.
struct PlacedPair {
  PlacedBalls a, b;
  QueryFrame frame;
};

PlacedPair place(const BodyTree& tree_a, std::span<const Ball> a, const BodyTree& tree_b, std::span<const Ball> b,
                 const Placement& placement) {
  return {place_a(tree_a, a, placement), place_b(tree_b, b, placement),
          QueryFrame(placement, tree_a.nodes().reach(), tree_b.nodes().reach())};
}

/// The balls that overlap a ball of `others`, smaller by `error` and by the share `stretch`, so that they lie in the
/// true ones. A point of both unions lies in a ball of each, and these two overlap: all other balls change nothing.
std::vector<Ball> that_meet(const PlacedBalls& set, const PlacedBalls& others, double error, double stretch) {
  std::vector<Ball> found;
  for (Ball ball : set.balls) {
    if (!comes_near(others, ball, 0)) continue;
    ball.radius = ball.radius * (1 - stretch) - error;
    if (ball.radius > 0) found.push_back(ball);
  }
  return found;
}

Status measure_common_volume(const BodyImpl& a, const BodyImpl& b, const Placement& placement,
                             const PenetrationOptions& options, Penetration& result) {
  const PlacedPair placed = place(a.inside_tree, a.inside, b.inside_tree, b.inside, placement);
  const std::vector<Ball> of_a = that_meet(placed.a, placed.b, placed.frame.error, 0);
  // The placed balls of b are larger by one stretch, and the true ones may be smaller by another.
  const std::vector<Ball> of_b = that_meet(placed.b, placed.a, placed.frame.error, 3 * QueryFrame::kStretch);
  if (of_a.empty() || of_b.empty()) return {};
  const Result<double> estimate = common_volume_of(of_a, of_b);
  if (!estimate) return estimate.error();
  result.common_volume_of_balls = estimate.value();
  result.common_volume_lower =
      common_volume_at_least(of_a, of_b, estimate.value(), options.volume_tolerance, options.most_columns);
  return {};
}

Result<Penetration> penetration_of(const Body& a, const Body& b, const Pose& pose, const PenetrationOptions& options) {
  Penetration result;
  const BodyImpl &in_a = Internals::of(a), &in_b = Internals::of(b);
  const Placement placement(in_a, in_b, pose);
  if (!placement.is_in_range()) return result;
  if (collide(a, b, pose) == Collision::kFree) {
    result.depth_upper = 0;
    return result;
  }
  if (!in_a.cover.empty() && !in_b.cover.empty()) {
    const PlacedPair placed = place(in_a.cover_tree, in_a.cover, in_b.cover_tree, in_b.cover, placement);
    const WayOut way = way_out(placed.a, placed.b, placed.frame, options.directions);
    result.translation = way.translation;
    result.depth_upper = way.length;
  }
  if (in_a.inside.empty() || in_b.inside.empty()) return result;
  const DepthBound bound = bound_depth(in_a, in_b, pose, result.depth_upper, options.most_queries);
  result.depth_lower = bound.lower;
  result.deepest = bound.deepest;
  if (bound.deepest.a == BallPair::kNone || options.volume_tolerance == 1) return result;
  if (Status status = measure_common_volume(in_a, in_b, placement, options, result); !status) return status.error();
  return result;
}

}  // namespace

Result<Penetration> penetration(const Body& a, const Body& b, const Pose& pose, const PenetrationOptions& options) {
  if (Status status = check(options); !status) return status.error();
  return catch_out_of_memory("measuring how far two solids lie in each other",
                             [&] { return penetration_of(a, b, pose, options); });
}

}  // namespace medial_vk
