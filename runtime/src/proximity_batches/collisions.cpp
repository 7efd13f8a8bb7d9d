#include "medial_vk/collisions.h"

#include <bit>

#include "base/eight_floats.h"
#include "base/parallel.h"
#include "proximity/body.h"
#include "proximity/large_balls.h"
#include "proximity/overlap_search.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

/// Whether some two of the balls have a smaller computed separation. Balls of b far from the ball around those of a are
/// left out.
MEDIAL_VK_INLINE bool are_closer(const LargeBalls& of_a, const LargeBalls& of_b, const FloatPose& pose,
                                 float separation) {
  const FloatBall& around = of_a.around();
  for (const BodyNode& b : of_b.nodes()) {
    const EightCentres centres = in_frame_of_a(b, pose);
    std::uint32_t near = bits_of(closer(centres.x - around.centre[0], centres.y - around.centre[1],
                                        centres.z - around.centre[2], load(b.radius) + (around.radius + separation))
                                     .where);
    const StoredCentres to = stored(centres);
    for (; near != 0; near &= near - 1) {
      const auto j = static_cast<std::uint32_t>(std::countr_zero(near));
      EightInts is_closer{};
      for (const BodyNode& a : of_a.nodes()) {
        is_closer |= closer(load(a.centre[0]) - to.x[j], load(a.centre[1]) - to.y[j], load(a.centre[2]) - to.z[j],
                            load(a.radius) + (b.radius[j] + separation))
                         .where;
      }
      if (bits_of(is_closer) != 0) return true;
    }
  }
  return false;
}

/// With E the greatest error of a separation: no separation of the covers below E proves that they are apart, and one
/// of the balls inside below -2E that two balls overlap, which are rounded up by less than E together.
MEDIAL_VK_INLINE Collision decide(const BodyImpl& a, const BodyImpl& b, const Pose& pose) {
  const Placement placement(a, b, pose);
  if (!placement.is_in_range()) return Collision::kUndecided;
  const FloatPose& placed = placement.float_pose();
  const NodeTree &inside_a = a.inside_tree.nodes(), &inside_b = b.inside_tree.nodes();
  const NodeTree &cover_a = a.cover_tree.nodes(), &cover_b = b.cover_tree.nodes();
  const bool has_inside = !inside_a.is_empty() && !inside_b.is_empty();
  const auto overlap = static_cast<float>(-2.000001 * placement.separation_error_of(inside_a, inside_b));
  if (has_inside && are_closer(a.large_inside, b.large_inside, placed, overlap)) return Collision::kHit;
  if (!cover_a.is_empty() && !cover_b.is_empty()) {
    const auto gap = static_cast<float>(1.000001 * placement.separation_error_of(cover_a, cover_b));
    if (!OverlapSearch(cover_a, cover_b, placed, gap).find()) return Collision::kFree;
  }
  if (has_inside && OverlapSearch(inside_a, inside_b, placed, overlap).find()) return Collision::kHit;
  return Collision::kUndecided;
}

constexpr std::size_t kBlock = 256;

}  // namespace

void collide_by_balls(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Collision> verdicts,
                      const BatchOptions& options) {
  const BodyImpl &in_a = Internals::of(a), &in_b = Internals::of(b);
  parallel_blocks(poses.size(), kBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    const auto decide_block = [&]() __attribute__((always_inline)) {
      for (std::size_t i = begin; i < end; ++i) verdicts[i] = decide(in_a, in_b, poses[i]);
    };
    run_on_this_processor(decide_block);
  });
}

void collide_by_balls(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<Collision> verdicts,
                      const BatchOptions& options) {
  parallel_blocks(pairs.size(), kBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    const auto decide_block = [&]() __attribute__((always_inline)) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [pose, a, b] = pairs[i];
        verdicts[i] = decide(Internals::of(bodies[a]), Internals::of(bodies[b]), pose);
      }
    };
    run_on_this_processor(decide_block);
  });
}

}  // namespace medial_vk
