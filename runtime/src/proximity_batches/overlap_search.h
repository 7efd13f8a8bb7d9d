// A search for two balls of two trees that are closer than a given separation: docs/theory.md, "Many poses".
#pragma once

#include <array>
#include <bit>
#include <type_traits>
#include <utility>

#include "medial_vk/proximity.h"
#include "proximity/tree_search.h"

namespace medial_vk {

/// Depth first, and of the pairs of a division the one that overlaps most first. Separations are compared by squares,
/// as separation_error() allows. Everything is inlined into its caller, which chooses the processor. Allocates nothing.
class OverlapSearch {
 public:
  /// Precondition: no tree is empty.
  OverlapSearch(const NodeTree& a, const NodeTree& b, const FloatPose& pose, float separation)
      : a_(a), b_(b), pose_(pose), separation_(separation) {}

  /// Whether two items have balls with a smaller computed separation than the given one.
  MEDIAL_VK_INLINE bool find() {
    tasks_[0] = {0, 0, 0, 0, 0, 0, kAllOfSpace};
    count_ = 1;
    while (count_ > 0) {
      const Task task = tasks_[--count_];
      if (compare(task)) return true;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kWidth = BodyNode::kWidth;
  /// More than the distance of any two points in range (Placement::is_in_range()).
  static constexpr float kAllOfSpace = 1.5e19f;

  /// Two nodes, one of each tree, whose balls are closer. Without initial values: those of a thousand tasks would take
  /// longer than most searches.
  struct Task {
    float overlap;  ///< The square of their distance less that of the reach: the less, the more they overlap.
    std::uint32_t node_a, node_b;
    float x, y, z, radius;  ///< A ball that holds the balls of node_a.
  };
  static_assert(std::is_trivially_default_constructible_v<Task>);

  /// All balls of one node with all of the other one, eight pairs at a time, except those of b that are far from the
  /// ball around those of a. True: two items were found.
  MEDIAL_VK_INLINE bool compare(const Task& task) {
    const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
    const EightFloats x = load(b.centre[0]), y = load(b.centre[1]), z = load(b.centre[2]);
    const auto& [row_x, row_y, row_z] = pose_.rows;
    const EightFloats in_a_x = row_x[0] * x + row_x[1] * y + row_x[2] * z + pose_.shift[0],
                      in_a_y = row_y[0] * x + row_y[1] * y + row_y[2] * z + pose_.shift[1],
                      in_a_z = row_z[0] * x + row_z[1] * y + row_z[2] * z + pose_.shift[2];
    std::uint32_t near = bits_of(
        closer(in_a_x - task.x, in_a_y - task.y, in_a_z - task.z, load(b.radius) + (task.radius + separation_)).where);
    if (near == 0) return false;
    const std::array<float, kWidth> to_x = stored(in_a_x), to_y = stored(in_a_y), to_z = stored(in_a_z);
    const EightFloats reach_a = load(a.radius) + separation_;
    first_ = count_;
    for (; near != 0; near &= near - 1) {
      const auto j = static_cast<std::uint32_t>(std::countr_zero(near));
      const Closer found = closer(load(a.centre[0]) - to_x[j], load(a.centre[1]) - to_y[j], load(a.centre[2]) - to_z[j],
                                  reach_a + b.radius[j]);
      const std::uint32_t pairs = bits_of(found.where);
      if (pairs == 0) continue;
      if (a.is_lowest && b.is_lowest) return true;
      push_all(task, a, b, j, pairs, stored(found.overlap));
    }
    return false;
  }

  struct Closer {
    EightInts where;
    EightFloats overlap;
  };
  MEDIAL_VK_INLINE static Closer closer(const EightFloats& x, const EightFloats& y, const EightFloats& z,
                                        const EightFloats& reach) {
    const EightFloats square = x * x + y * y + z * z, square_of_reach = reach * reach;
    return {(square < square_of_reach) & (reach > 0), square - square_of_reach};
  }

  /// The pairs of ball j of b with some of a.
  MEDIAL_VK_INLINE void push_all(const Task& task, const BodyNode& a, const BodyNode& b, std::uint32_t j,
                                 std::uint32_t pairs, const std::array<float, kWidth>& overlaps) {
    const std::uint32_t below_b = b.is_lowest ? task.node_b : b.below[j];
    for (; pairs != 0; pairs &= pairs - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(pairs));
      if (a.is_lowest) {
        push({overlaps[k], task.node_a, below_b, task.x, task.y, task.z, task.radius});
        return;  // the others are the same task
      }
      const Task below = {overlaps[k],    a.below[k],     below_b,    a.centre[0][k],
                          a.centre[1][k], a.centre[2][k], a.radius[k]};
      if (!b.is_lowest || !repeats(below)) push(below);
    }
  }

  MEDIAL_VK_INLINE bool repeats(const Task& task) const {
    for (std::size_t slot = first_; slot < count_; ++slot) {
      if (tasks_[slot].node_a == task.node_a && tasks_[slot].node_b == task.node_b) return true;
    }
    return false;
  }

  /// Of the tasks of one division the one that overlaps most is the last.
  MEDIAL_VK_INLINE void push(const Task& task) {
    tasks_[count_] = task;
    if (count_ > first_ && tasks_[count_ - 1].overlap < task.overlap) std::swap(tasks_[count_ - 1], tasks_[count_]);
    ++count_;
  }

  /// A comparison replaces a task by up to 64, at most once for each level of both trees.
  static constexpr std::size_t kMostTasks = 1 + (kWidth * kWidth - 1) * 2 * node_levels(kMostBodyBalls);

  const NodeTree& a_;
  const NodeTree& b_;
  const FloatPose& pose_;
  float separation_;
  std::size_t count_ = 0, first_ = 0;
  std::array<Task, kMostTasks> tasks_;
};

}  // namespace medial_vk
