#include "proximity/closest_balls.h"

#include <cmath>

namespace medial_vk {
namespace {

struct BallsGoal {
  static constexpr bool kHasExcess = false;

  ClosestBalls best;
  float enough;

  MEDIAL_VK_INLINE float reach() const { return best.separation; }
  MEDIAL_VK_INLINE bool take(const CloseItems& items) {
    best = {items.separation, {items.a, items.b}};
    return false;
  }
  MEDIAL_VK_INLINE void see(float, const BallsOfNodes&) const {}
  MEDIAL_VK_INLINE static std::uint64_t pairs_of(std::uint32_t, std::uint32_t) { return ~std::uint64_t{0}; }
  MEDIAL_VK_INLINE bool is_reached() const { return best.separation <= enough; }
};

ClosestBalls pair_of(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& pair) {
  if (pair.a >= a.size() || pair.b >= b.size()) return {};
  const FloatBall &of_a = a.leaf(pair.a), &of_b = b.leaf(pair.b);
  const std::array<float, 3> centre = pose.to_a(of_b.centre);
  const float x = of_a.centre[0] - centre[0], y = of_a.centre[1] - centre[1], z = of_a.centre[2] - centre[2];
  return {std::sqrt(x * x + y * y + z * z) - (of_a.radius + of_b.radius), pair};
}

}  // namespace

ClosestBalls closest_balls(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start,
                           float enough, float most) {
  BallsGoal goal{pair_of(a, b, pose, start), enough};
  if (most < goal.best.separation) goal.best = {most, {}};
  const bool has_start = goal.best.separation < kFarther;
  TreeSearch search(a.nodes(), b.nodes(), pose, goal);
  const auto run = [&]() __attribute__((always_inline)) {
    if (!has_start) search.dive();
    search.run();
  };
  run_on_this_processor(run);
  return goal.best;
}

}  // namespace medial_vk
