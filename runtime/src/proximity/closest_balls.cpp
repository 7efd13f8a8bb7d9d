#include "proximity/closest_balls.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "proximity/eight_floats.h"

namespace medial_vk {
namespace {

constexpr float kFarther = 1e30f;  // More than any separation of two balls, and less than that of an unused slot.
constexpr std::size_t kWidth = BodyNode::kWidth;

/// Two nodes, one of each tree, below which there may be a closer pair.
struct Task {
  float separation;
  std::uint32_t node_a, node_b;
};

/// Depth first, and of the pairs of a division the closest first.
class Search {
 public:
  Search(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start, float enough)
      : a_(a), b_(b), pose_(pose), enough_(enough) {
    if (start.a >= a.size() || start.b >= b.size()) return;
    const FloatBall &of_a = a.leaf(start.a), &of_b = b.leaf(start.b);
    const std::array<float, 3> centre = pose.to_a(of_b.centre);
    const float x = of_a.centre[0] - centre[0], y = of_a.centre[1] - centre[1], z = of_a.centre[2] - centre[2];
    best_ = {std::sqrt(x * x + y * y + z * z) - (of_a.radius + of_b.radius), start};
  }

  MEDIAL_VK_INLINE ClosestBalls run() {
    if (best_.separation == kFarther) dive();
    tasks_[0] = {-kFarther, 0, 0};
    count_ = 1;
    while (count_ > 0 && best_.separation > enough_) {
      const Task task = tasks_[--count_];
      if (task.separation < best_.separation) compare(task);
    }
    return best_;
  }

 private:
  /// The centres of a node's balls in the frame of a.
  struct Centres {
    std::array<std::array<float, kWidth>, 3> of;
  };

  MEDIAL_VK_INLINE Centres in_frame_of_a(const BodyNode& b) const {
    const EightFloats x = load(b.centre[0]), y = load(b.centre[1]), z = load(b.centre[2]);
    Centres centres;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<float, 3>& row = pose_.rows[i];
      centres.of[i] = stored(row[0] * x + row[1] * y + row[2] * z + pose_.shift[i]);
    }
    return centres;
  }

  /// From the eight balls of a node of a to ball `j` of a node of b.
  MEDIAL_VK_INLINE static EightFloats squared_distances(const BodyNode& a, const Centres& centres, std::size_t j) {
    const EightFloats x = load(a.centre[0]) - centres.of[0][j], y = load(a.centre[1]) - centres.of[1][j],
                      z = load(a.centre[2]) - centres.of[2][j];
    return x * x + y * y + z * z;
  }

  /// Straight down to two balls, by way of the closest two of each division, for a first bound.
  MEDIAL_VK_INLINE void dive() {
    std::uint32_t node_a = 0, node_b = 0;
    while (true) {
      const BodyNode &a = a_.node(node_a), &b = b_.node(node_b);
      const Centres centres = in_frame_of_a(b);
      EightFloats least = kFarther - EightFloats{};
      EightInts with{};
      for (std::uint32_t j = 0; j < b.count; ++j) {
        const EightFloats separations = square_root(squared_distances(a, centres, j)) - (load(a.radius) + b.radius[j]);
        const EightInts is_less = separations < least;
        least = select(is_less, separations, least);
        with = (is_less & static_cast<std::int32_t>(j)) | (~is_less & with);
      }
      std::size_t k = 0;
      for (std::size_t i = 1; i < kWidth; ++i) k = least[i] < least[k] ? i : k;
      const std::uint32_t below_a = a.below[k], below_b = b.below[with[k]];
      if (a.is_lowest && b.is_lowest) {
        best_ = {least[k], {below_a, below_b}};
        return;
      }
      if (!a.is_lowest) node_a = below_a;
      if (!b.is_lowest) node_b = below_b;
    }
  }

  /// All balls of one node with all of the other one, eight pairs at a time; square roots are left to closer pairs.
  MEDIAL_VK_INLINE void compare(const Task& task) {
    const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
    const Centres centres = in_frame_of_a(b);
    const EightFloats reach_a = load(a.radius) + best_.separation;
    std::uint64_t closer = 0;  // bit 8 j + k: ball k of a and ball j of b
    for (std::uint32_t j = 0; j < kWidth; ++j) {
      const EightFloats reach = reach_a + b.radius[j];
      const EightInts is_closer = (squared_distances(a, centres, j) < reach * reach) & (reach > 0);
      closer |= std::uint64_t{bits_of(is_closer)} << (kWidth * j);
    }
    first_ = count_;
    for (; closer != 0; closer &= closer - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(closer));
      const std::uint32_t k = bit % kWidth, j = bit / kWidth;
      const float x = a.centre[0][k] - centres.of[0][j], y = a.centre[1][k] - centres.of[1][j],
                  z = a.centre[2][k] - centres.of[2][j];
      take(std::sqrt(x * x + y * y + z * z) - (a.radius[k] + b.radius[j]), task, a, k, b, j);
    }
  }

  /// A pair that was closer than the best so far when its nodes were compared.
  MEDIAL_VK_INLINE void take(float separation, const Task& task, const BodyNode& a, std::uint32_t k, const BodyNode& b,
                             std::uint32_t j) {
    if (a.is_lowest && b.is_lowest) {
      if (separation < best_.separation) best_ = {separation, {a.below[k], b.below[j]}};
      return;
    }
    const Task below = {separation, a.is_lowest ? task.node_a : a.below[k], b.is_lowest ? task.node_b : b.below[j]};
    if (a.is_lowest == b.is_lowest || !repeats(below)) push(below);
  }

  /// A node of the lowest level is not replaced, so several of its balls may give the same task: the closest one does.
  MEDIAL_VK_INLINE bool repeats(const Task& task) {
    std::size_t slot = first_;
    while (slot < count_ && (tasks_[slot].node_a != task.node_a || tasks_[slot].node_b != task.node_b)) ++slot;
    if (slot == count_) return false;
    if (tasks_[slot].separation <= task.separation) return true;
    for (--count_; slot < count_; ++slot) tasks_[slot] = tasks_[slot + 1];
    return false;
  }

  /// The tasks of one division are in the order of decreasing separation.
  MEDIAL_VK_INLINE void push(const Task& task) {
    std::size_t slot = count_++;
    for (; slot > first_ && tasks_[slot - 1].separation < task.separation; --slot) tasks_[slot] = tasks_[slot - 1];
    tasks_[slot] = task;
  }

  /// A comparison replaces a task by up to 64, at most once for each level of both trees.
  static constexpr std::size_t kMostTasks = 1 + (kWidth * kWidth - 1) * 2 * body_tree_levels(kMostBodyBalls);

  const BodyTree& a_;
  const BodyTree& b_;
  const FloatPose& pose_;
  float enough_;
  ClosestBalls best_ = {kFarther, {}};
  std::size_t count_ = 0, first_ = 0;
  std::array<Task, kMostTasks> tasks_;
};

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) ClosestBalls search_with_avx2(const BodyTree& a, const BodyTree& b,
                                                              const FloatPose& pose, const BallPair& start,
                                                              float enough) {
  return Search(a, b, pose, start, enough).run();
}
#endif

ClosestBalls search(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start, float enough) {
  return Search(a, b, pose, start, enough).run();
}

}  // namespace

FloatPose::FloatPose(const Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = static_cast<float>(pose.rotation[i][j]);
    shift[i] = static_cast<float>(pose.shift[i]);
  }
}

ClosestBalls closest_balls(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start,
                           float enough) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2")) return search_with_avx2(a, b, pose, start, enough);
#endif
  return search(a, b, pose, start, enough);
}

}  // namespace medial_vk
