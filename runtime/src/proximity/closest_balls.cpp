#include "proximity/closest_balls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#if defined(__GNUC__) || defined(__clang__)
#define MEDIAL_VK_INLINE inline __attribute__((always_inline))
#else
#define MEDIAL_VK_INLINE inline
#endif

namespace medial_vk {
namespace {

constexpr float kFarther = 1e30f;  // than any two balls, and less than the separation to an unused place
constexpr std::size_t kWidth = BallNode::kWidth;

bool is_leaf(std::uint32_t below) { return (below & BallTree::kLeaf) != 0; }

/// Two balls, one of each tree, whose parts may hold a closer pair. Each centre is in the frame of its own tree.
struct Task {
  float separation;
  std::uint32_t below_a, below_b;
  FloatBall a, b;
};

MEDIAL_VK_INLINE float separation_of(const FloatBall& a, const std::array<float, 3>& centre_b, float radius_b) {
  const float x = a.centre[0] - centre_b[0], y = a.centre[1] - centre_b[1], z = a.centre[2] - centre_b[2];
  return std::sqrt(x * x + y * y + z * z) - (a.radius + radius_b);
}

/// The separations between a ball and the eight of a node, in the frame of the node.
MEDIAL_VK_INLINE void separations_from(const BallNode& node, const std::array<float, 3>& centre, float radius,
                                       std::array<float, kWidth>& separations) {
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float x = node.centre[0][k] - centre[0], y = node.centre[1][k] - centre[1], z = node.centre[2][k] - centre[2];
    separations[k] = std::sqrt(x * x + y * y + z * z) - (node.radius[k] + radius);
  }
}

/// Depth first, the closest part of each division first: the first descent gives a bound for all that follows.
class Search {
 public:
  Search(const BallTree& a, const BallTree& b, const FloatPose& pose, const BallPair& start, float enough)
      : a_(a), b_(b), pose_(pose), enough_(enough) {
    if (start.a < a.size() && start.b < b.size()) {
      const FloatBall& other = b.leaf(start.b);
      best_ = {separation_of(a.leaf(start.a), pose.to_a(other.centre), other.radius), start};
    }
  }

  MEDIAL_VK_INLINE ClosestBalls run() {
    tasks_[0] = {-kFarther, 0, 0, a_.root_ball(), b_.root_ball()};
    count_ = 1;
    while (count_ > 0 && best_.separation > enough_) {
      const Task task = tasks_[--count_];
      if (task.separation < best_.separation) divide(task);
    }
    return best_;
  }

 private:
  /// The larger ball is replaced by its parts.
  MEDIAL_VK_INLINE void divide(const Task& task) {
    if (is_leaf(task.below_b) || (!is_leaf(task.below_a) && task.a.radius >= task.b.radius)) {
      divide_into<true>(task, a_.node(task.below_a), pose_.to_a(task.b.centre), task.b.radius, task.below_b);
    } else {
      divide_into<false>(task, b_.node(task.below_b), pose_.to_b(task.a.centre), task.a.radius, task.below_a);
    }
  }

  template <bool kOfA>
  MEDIAL_VK_INLINE void divide_into(const Task& task, const BallNode& node, const std::array<float, 3>& centre,
                                    float radius, std::uint32_t below_other) {
    alignas(32) std::array<float, kWidth> separations;
    separations_from(node, centre, radius, separations);
    std::array<std::uint32_t, kWidth> order;
    std::size_t found = 0;
    const bool other_is_leaf = is_leaf(below_other);
    for (std::uint32_t k = 0; k < kWidth; ++k) {
      if (!(separations[k] < best_.separation)) continue;
      if (other_is_leaf && is_leaf(node.below[k])) {
        const std::uint32_t mine = node.below[k] & ~BallTree::kLeaf, others = below_other & ~BallTree::kLeaf;
        best_ = {separations[k], kOfA ? BallPair{mine, others} : BallPair{others, mine}};
        continue;
      }
      std::size_t place = found++;
      for (; place > 0 && separations[order[place - 1]] < separations[k]; --place) order[place] = order[place - 1];
      order[place] = k;
    }
    for (std::size_t i = 0; i < found; ++i) {
      const std::uint32_t k = order[i];
      if (!(separations[k] < best_.separation)) continue;
      tasks_[count_++] = kOfA ? Task{separations[k], node.below[k], task.below_b, node.ball(k), task.b}
                              : Task{separations[k], task.below_a, node.below[k], task.a, node.ball(k)};
    }
  }

  /// A division replaces a task by up to eight, and two trees have so many levels together.
  static constexpr std::size_t kMostTasks = 1 + (kWidth - 1) * 2 * ball_tree_levels(kMostBodyBalls);

  const BallTree& a_;
  const BallTree& b_;
  const FloatPose& pose_;
  float enough_;
  ClosestBalls best_ = {kFarther, {}};
  std::size_t count_ = 0;
  std::array<Task, kMostTasks> tasks_;
};

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) ClosestBalls search_with_avx2(const BallTree& a, const BallTree& b,
                                                              const FloatPose& pose, const BallPair& start,
                                                              float enough) {
  return Search(a, b, pose, start, enough).run();
}
#endif

ClosestBalls search(const BallTree& a, const BallTree& b, const FloatPose& pose, const BallPair& start, float enough) {
  return Search(a, b, pose, start, enough).run();
}

}  // namespace

FloatPose::FloatPose(const Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rows[i][j] = static_cast<float>(pose.rotation[i][j]);
      columns[j][i] = rows[i][j];
    }
    shift[i] = static_cast<float>(pose.shift[i]);
  }
}

ClosestBalls closest_balls(const BallTree& a, const BallTree& b, const FloatPose& pose, const BallPair& start,
                           float enough) {
#if defined(__x86_64__) && defined(__GNUC__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") > 0;
  if (has_avx2) return search_with_avx2(a, b, pose, start, enough);
#endif
  return search(a, b, pose, start, enough);
}

}  // namespace medial_vk
