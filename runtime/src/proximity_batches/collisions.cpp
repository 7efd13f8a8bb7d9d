#include "medial_vk/collisions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "proximity/body.h"
#include "proximity/placement.h"
#include "proximity_batches/overlap_search.h"

namespace medial_vk {
namespace {

/// A few large balls of a set that lie far apart: most bodies that overlap do so by these.
class LargeBalls {
 public:
  static constexpr std::size_t kNodes = 2;

  /// Each ball in turn is the one that reaches farthest out of those before it.
  explicit LargeBalls(const BodyTree& tree) {
    std::vector<double> by(tree.size());
    for (std::uint32_t i = 0; i < tree.size(); ++i) by[i] = tree.leaf(i).radius;
    for (std::size_t n = 0; n < std::min(tree.size(), kNodes * BodyNode::kWidth); ++n) {
      const auto next = static_cast<std::uint32_t>(std::max_element(by.begin(), by.end()) - by.begin());
      const FloatBall& ball = tree.leaf(next);
      BodyNode& node = nodes_[n / BodyNode::kWidth];
      for (std::size_t axis = 0; axis < 3; ++axis) node.centre[axis][node.count] = ball.centre[axis];
      node.radius[node.count++] = ball.radius;
      for (std::uint32_t i = 0; i < tree.size(); ++i) {
        const FloatBall& other = tree.leaf(i);
        const double apart = length(point_of(other) - point_of(ball));
        by[i] = std::min(by[i], apart + other.radius - ball.radius);
      }
      by[next] = -std::numeric_limits<double>::infinity();
    }
  }

  const std::array<BodyNode, kNodes>& nodes() const { return nodes_; }

 private:
  std::array<BodyNode, kNodes> nodes_ = {};
};

/// Whether some two of the balls have a smaller computed separation.
MEDIAL_VK_INLINE bool are_closer(const LargeBalls& of_a, const LargeBalls& of_b, const FloatPose& pose,
                                 float separation) {
  for (const BodyNode& b : of_b.nodes()) {
    for (const BodyNode& a : of_a.nodes()) {
      EightInts closer{};
      for (std::uint32_t j = 0; j < b.count; ++j) {
        const std::array<float, 3> to = pose.to_a({b.centre[0][j], b.centre[1][j], b.centre[2][j]});
        const EightFloats x = load(a.centre[0]) - to[0], y = load(a.centre[1]) - to[1], z = load(a.centre[2]) - to[2],
                          reach = load(a.radius) + (b.radius[j] + separation);
        closer |= (x * x + y * y + z * z < reach * reach) & (reach > 0);
      }
      if ((bits_of(closer) & ((1u << a.count) - 1u)) != 0) return true;
    }
  }
  return false;
}

/// Two bodies with their large balls.
struct Colliders {
  const BodyImpl& a;
  const BodyImpl& b;
  LargeBalls large_a, large_b;

  Colliders(const BodyImpl& of_a, const BodyImpl& of_b)
      : a(of_a), b(of_b), large_a(of_a.inside_tree), large_b(of_b.inside_tree) {}

  /// With E the greatest error of a separation: no separation of the covers below E proves that they are apart, and one
  /// of the balls inside below -2E that two balls overlap, which are rounded up by less than E together.
  MEDIAL_VK_INLINE Collision decide(const Placement& placement) const {
    const FloatPose& pose = placement.float_pose();
    const NodeTree &inside_a = a.inside_tree.nodes(), &inside_b = b.inside_tree.nodes();
    const NodeTree &cover_a = a.cover_tree.nodes(), &cover_b = b.cover_tree.nodes();
    const bool has_inside = !inside_a.is_empty() && !inside_b.is_empty();
    const auto overlap = static_cast<float>(-2.000001 * placement.separation_error_of(inside_a, inside_b));
    if (has_inside && are_closer(large_a, large_b, pose, overlap)) return Collision::kHit;
    if (!cover_a.is_empty() && !cover_b.is_empty()) {
      const auto gap = static_cast<float>(1.000001 * placement.separation_error_of(cover_a, cover_b));
      if (!OverlapSearch(cover_a, cover_b, pose, gap).find()) return Collision::kFree;
    }
    if (has_inside && OverlapSearch(inside_a, inside_b, pose, overlap).find()) return Collision::kHit;
    return Collision::kUndecided;
  }
};

}  // namespace

void collide_by_balls(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Collision> verdicts,
                      const BatchOptions& options) {
  constexpr std::size_t kBlock = 256;
  const Colliders bodies(Internals::of(a), Internals::of(b));
  parallel_blocks(poses.size(), kBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    const auto decide = [&]() __attribute__((always_inline)) {
      for (std::size_t i = begin; i < end; ++i) {
        const Placement placement(bodies.a, bodies.b, poses[i]);
        verdicts[i] = placement.is_in_range() ? bodies.decide(placement) : Collision::kUndecided;
      }
    };
    search_on_this_processor(decide);
  });
}

}  // namespace medial_vk
