// A search for close items of two trees in a pose: docs/theory.md, "Distances".
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/eight_floats.h"
#include "medial_vk/pose.h"
#include "proximity/node_tree.h"

namespace medial_vk {

/// A pose between the frames of two trees, whose origins are the centres of their bodies.
struct FloatPose {
  std::array<std::array<float, 3>, 3> rows;  ///< Of the rotation.
  std::array<float, 3> shift;

  explicit FloatPose(const Pose& pose) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] = static_cast<float>(pose.rotation[i][j]);
      shift[i] = static_cast<float>(pose.shift[i]);
    }
  }

  std::array<float, 3> to_a(const std::array<float, 3>& p) const {
    std::array<float, 3> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = rows[i][0] * p[0] + rows[i][1] * p[1] + rows[i][2] * p[2] + shift[i];
    return out;
  }
};

/// The greatest error of a computed separation of two balls of the trees, where the origins of the two frames are
/// `distance` apart. (The separation of two balls is the distance between their centres less both radii.) Let M be the
/// sum of the two reaches and `distance`, which bounds every length below, and u = 2^-24. A centre in the other frame
/// costs, in each coordinate, one rounding of the entries of the rotation and of the shift, and four of products and
/// sums: 5.1 u times a sum of absolute values that is at most M. The vector so has an error of sqrt(3) 5.1 u M < 9 u M,
/// its difference to the other centre one of u M more, its length 4 u M more, and the sum of the radii and the last
/// difference 2 u M more: 16 u M. A comparison of squares, of a distance and of a sum of a separation and two radii, in
/// the place of a square root has no more roundings. Rows that are perpendicular unit vectors only to within 1e-12 add
/// less than u M. Squares may underflow, also to zero where a program has no subnormal numbers: each by less than
/// 2^-125, and a length by less than 2^-61.
inline double separation_error(const NodeTree& a, const NodeTree& b, double distance) {
  return 18 * 0x1p-24 * (a.reach() + b.reach() + distance) + 0x1p-60;
}

/// Two items, and the computed separation of their balls.
struct CloseItems {
  float separation;
  std::uint32_t a, b;
};

/// Ball k of a node of a and ball j of a node of b.
struct BallsOfNodes {
  const BodyNode* a;
  const BodyNode* b;
  std::uint32_t k, j;
};

/// More than any separation of two balls, and less than that of an unused slot.
constexpr float kFarther = 1e30f;

/// Among balls with an excess. Depth first, and of the pairs of a division that of the least sum of the separation and
/// both excesses first. `Goal` has the members
///   float reach() const                 pairs of balls with a computed separation of this or more are passed over
///   void see(separation, BallsOfNodes)  two balls that are closer; may shorten the reach
///   uint64 pairs_of(node_a, node_b)     of two nodes: bit 8 k + j, unless what ball k of a and ball j of b hold is
///                                       known to be too far apart
///   bool take(const CloseItems&)        two items whose balls are closer; may shorten the reach; true: pairs_of() may
///                                       rule out more now
///   bool is_reached() const             true ends the search
///   void wait(float separation)         with a budget only: the pairs that are still to be compared have computed
///                                       separations of at least this
/// Everything is inlined into its caller, which chooses the processor. Allocates nothing.
template <class Goal>
class TreeSearch {
 public:
  /// Preconditions: no tree is empty.
  TreeSearch(const NodeTree& a, const NodeTree& b, const FloatPose& pose, Goal& goal)
      : a_(a), b_(b), pose_(pose), goal_(goal) {}

  /// Straight down to two items, by way of the closest two balls of each division, for a first bound; of balls with
  /// their excess, by way of those with the least sum of their separation and both excesses. What was computed on the
  /// last way down is kept for run().
  template <bool kWithExcess = false>
  MEDIAL_VK_INLINE void dive() {
    steps_ = 0;
    Task task = kAll;
    while (true) {
      const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
      Step& step = dive_[steps_++];
      step.task = task;
      const auto [k, j] = find_closest<kWithExcess>(a, b, step);
      const float separation = step.separations[j][k];
      step.closest = kWithExcess ? -kFarther : separation;
      if (a.is_lowest && b.is_lowest) {
        goal_.take({separation, a.below[k], b.below[j]});
        return;
      }
      task = task_below(separation, task, a, k, b, j);
    }
  }

  MEDIAL_VK_INLINE void run() {
    begin();
    while (count_ > 0 && !goal_.is_reached()) {
      const Task task = tasks_[--count_];
      if (task.separation < goal_.reach()) compare(task);
    }
  }

  /// No more than so many comparisons. What remains decides what is known then, so those that are closest come first,
  /// as long as there is room for a search depth first from there.
  MEDIAL_VK_INLINE void run(std::uint64_t most_comparisons) {
    begin();
    const std::size_t room_below = (kWidth * kWidth - 1) * (a_.levels() + b_.levels()) + 1;
    while (count_ > 0 && !goal_.is_reached()) {
      std::size_t closest = count_ - 1;
      for (std::size_t i = 0; i < count_; ++i)
        closest = tasks_[i].separation < tasks_[closest].separation ? i : closest;
      goal_.wait(tasks_[closest].separation);
      if (most_comparisons == 0 || tasks_[closest].separation >= goal_.reach()) return;
      if (count_ + room_below <= kMostTasks) std::swap(tasks_[closest], tasks_[count_ - 1]);
      const Task task = tasks_[--count_];
      if (task.separation >= goal_.reach()) continue;
      compare(task);
      --most_comparisons;
    }
    if (count_ == 0) goal_.wait(kFarther);
  }

 private:
  static constexpr std::size_t kWidth = BodyNode::kWidth;
  static constexpr std::size_t kMostItems = std::size_t{1} << 31;

  /// Two nodes, one of each tree, below which there may be a closer pair.
  struct Task {
    float separation;
    std::uint32_t node_a, node_b;
    std::uint32_t above_a;  ///< Ball k of node n, 8 n + k, holds the balls of node_a; kNoBall: the root has none.
  };
  static constexpr std::uint32_t kNoBall = ~std::uint32_t{0};

  static constexpr Task kAll = {-kFarther, 0, 0, kNoBall};
  static constexpr Task kNone = {kFarther, kNoBall, kNoBall, kNoBall};

  /// Two nodes that dive() went through, and the separations of all their balls: of ball k of a in [j][k].
  struct Step {
    Task task;
    float closest;  ///< No separation is less.
    alignas(32) std::array<std::array<float, kWidth>, kWidth> separations;
  };

  /// Fills in the separations, and gives the indices k and j of the closest two balls.
  template <bool kWithExcess>
  MEDIAL_VK_INLINE std::array<std::uint32_t, 2> find_closest(const BodyNode& a, const BodyNode& b, Step& step) const {
    const Centres centres = in_frame_of_a(b);
    EightFloats least = kFarther - EightFloats{};
    EightInts with{};
    for (std::uint32_t j = 0; j < b.count; ++j) {
      EightFloats separations = square_root(squared_distances(a, centres, j)) - (load(a.radius) + b.radius[j]);
      step.separations[j] = stored(separations);
      if constexpr (kWithExcess) separations += load(a.excess) + b.excess[j];
      const EightInts is_less = separations < least;
      least = select(is_less, separations, least);
      with = (is_less & static_cast<std::int32_t>(j)) | (~is_less & with);
    }
    std::uint32_t k = 0;
    for (std::uint32_t i = 1; i < kWidth; ++i) k = least[i] < least[k] ? i : k;
    return {k, static_cast<std::uint32_t>(with[k])};
  }

  /// Tasks for all pairs, or, after a dive, for those beside its way; those of its last step are taken.
  MEDIAL_VK_INLINE void begin() {
    if (steps_ == 0) tasks_[count_++] = kAll;
    for (std::size_t i = 0; i < steps_ && !goal_.is_reached(); ++i) {
      if (dive_[i].closest >= goal_.reach()) continue;
      on_way_ = i + 1 < steps_ ? dive_[i + 1].task : kAll;
      open(dive_[i]);
    }
    on_way_ = kAll;
  }

  MEDIAL_VK_INLINE void open(const Step& step) {
    const Task& task = step.task;
    const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
    EightInts closer_to_a{};
    for (std::uint32_t j = 0; j < b.count; ++j) {
      closer_to_a |= (load(step.separations[j]) < goal_.reach()) & static_cast<std::int32_t>(1u << j);
    }
    std::uint64_t closer = bytes_of(closer_to_a);
    if (closer != 0) closer &= goal_.pairs_of(task.node_a, task.node_b);
    go_on(
        task, a, b, closer, [&](std::uint32_t k, std::uint32_t j) __attribute__((always_inline)) {
          return step.separations[j][k];
        });
  }

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

  /// The balls of b that may be closer than the reach to a ball of node_a: bit j.
  MEDIAL_VK_INLINE std::uint32_t near_balls(const Task& task, const BodyNode& b, const Centres& centres) const {
    if (task.above_a == kNoBall) return (1u << kWidth) - 1;
    const BodyNode& above = a_.node(task.above_a / kWidth);
    const std::size_t k = task.above_a % kWidth;
    const EightFloats x = load(centres.of[0]) - above.centre[0][k], y = load(centres.of[1]) - above.centre[1][k],
                      z = load(centres.of[2]) - above.centre[2][k];
    const EightFloats reach = load(b.radius) + (above.radius[k] + goal_.reach());
    return bits_of((x * x + y * y + z * z < reach * reach) & (reach > 0));
  }

  /// All balls of one node with the near ones of the other, eight pairs at a time; square roots are left to closer
  /// pairs.
  MEDIAL_VK_INLINE void compare(const Task& task) {
    const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
    const bool are_lowest = a.is_lowest && b.is_lowest;
    // What the goal knows of items rules out most pairs of nodes at once; of other nodes, balls rule out more.
    const std::uint64_t may_be_closer = are_lowest ? goal_.pairs_of(task.node_a, task.node_b) : ~std::uint64_t{0};
    if (may_be_closer == 0) return;
    const Centres centres = in_frame_of_a(b);
    const EightFloats reach_a = load(a.radius) + goal_.reach();
    EightInts closer_to_a{};  // bit j of element k: ball k of a and ball j of b
    for (std::uint32_t near = near_balls(task, b, centres); near != 0; near &= near - 1) {
      const auto j = static_cast<std::uint32_t>(std::countr_zero(near));
      const EightFloats reach = reach_a + b.radius[j];
      const EightInts is_closer = (squared_distances(a, centres, j) < reach * reach) & (reach > 0);
      closer_to_a |= is_closer & static_cast<std::int32_t>(1u << j);
    }
    std::uint64_t closer = bytes_of(closer_to_a) & may_be_closer;
    if (closer != 0 && !are_lowest) closer &= goal_.pairs_of(task.node_a, task.node_b);
    go_on(
        task, a, b, closer, [&](std::uint32_t k, std::uint32_t j) __attribute__((always_inline)) {
          const float x = a.centre[0][k] - centres.of[0][j], y = a.centre[1][k] - centres.of[1][j],
                      z = a.centre[2][k] - centres.of[2][j];
          return std::sqrt(x * x + y * y + z * z) - (a.radius[k] + b.radius[j]);
        });
  }

  /// With pairs that were closer than the reach when their nodes were compared: bit 8 k + j.
  template <class Separation>
  MEDIAL_VK_INLINE void go_on(const Task& task, const BodyNode& a, const BodyNode& b, std::uint64_t closer,
                              const Separation& separation_of) {
    if (a.is_lowest && b.is_lowest) {
      take_items(task, a, b, closer, separation_of);
      return;
    }
    const std::size_t first = count_;
    // The best one of the division so far becomes the last one; sorting all would take longer than it saves.
    Task next = kNone;
    float least = std::numeric_limits<float>::max();
    for (; closer != 0; closer &= closer - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(closer));
      const std::uint32_t k = bit / kWidth, j = bit % kWidth;
      const float separation = separation_of(k, j);
      goal_.see(separation, {&a, &b, k, j});
      Task below = task_below(separation, task, a, k, b, j);
      if (are_same(below, on_way_)) continue;
      if (a.is_lowest != b.is_lowest && repeats(below, first, next)) continue;
      const float order = separation + (a.excess[k] + b.excess[j]);
      if (order < least) {
        least = order;
        std::swap(below, next);
      }
      tasks_[count_] = below;
      count_ += below.node_a != kNoBall ? 1 : 0;
    }
    if (next.node_a != kNoBall) tasks_[count_++] = next;
  }

  template <class Separation>
  MEDIAL_VK_INLINE void take_items(const Task& task, const BodyNode& a, const BodyNode& b, std::uint64_t closer,
                                   const Separation& separation_of) {
    while (closer != 0) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(closer));
      closer &= closer - 1;
      const std::uint32_t k = bit / kWidth, j = bit % kWidth;
      const float separation = separation_of(k, j);
      if (!(separation < goal_.reach())) continue;
      goal_.see(separation, {&a, &b, k, j});
      const bool knows_more = goal_.take({separation, a.below[k], b.below[j]});
      if (knows_more && closer != 0) closer &= goal_.pairs_of(task.node_a, task.node_b);
    }
  }

  MEDIAL_VK_INLINE static Task task_below(float separation, const Task& task, const BodyNode& a, std::uint32_t k,
                                          const BodyNode& b, std::uint32_t j) {
    return {separation, a.is_lowest ? task.node_a : a.below[k], b.is_lowest ? task.node_b : b.below[j],
            a.is_lowest ? task.above_a : static_cast<std::uint32_t>(task.node_a * kWidth + k)};
  }

  MEDIAL_VK_INLINE static bool are_same(const Task& x, const Task& y) {
    return x.node_a == y.node_a && x.node_b == y.node_b;
  }

  /// A node of the lowest level is not replaced, so several of its balls may give the same task: the closest one does.
  MEDIAL_VK_INLINE bool repeats(const Task& task, std::size_t first, Task& next) {
    if (are_same(task, next)) {
      next.separation = task.separation < next.separation ? task.separation : next.separation;
      return true;
    }
    std::size_t slot = first;
    while (slot < count_ && !are_same(task, tasks_[slot])) ++slot;
    if (slot == count_) return false;
    if (tasks_[slot].separation <= task.separation) return true;
    for (--count_; slot < count_; ++slot) tasks_[slot] = tasks_[slot + 1];
    return false;
  }

  /// A comparison replaces a task by up to 64, at most once for each level of both trees.
  static constexpr std::size_t kMostTasks = 1 + (kWidth * kWidth - 1) * 2 * node_levels(kMostItems);

  const NodeTree& a_;
  const NodeTree& b_;
  const FloatPose& pose_;
  Goal& goal_;
  std::size_t count_ = 0, steps_ = 0;
  Task on_way_ = kAll;  // the next step of the way down, which is no task of its own
  std::array<Task, kMostTasks> tasks_;
  std::array<Step, node_levels(kMostItems)> dive_;
};

}  // namespace medial_vk
