#include "proximity/closest_balls.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "proximity/overlap_search.h"

namespace medial_vk {
namespace {

MEDIAL_VK_INLINE float separation_of(const FloatBall& of_a, const FloatBall& of_b, const FloatPose& pose) {
  const std::array<float, 3> centre = pose.to_a(of_b.centre);
  const float x = of_a.centre[0] - centre[0], y = of_a.centre[1] - centre[1], z = of_a.centre[2] - centre[2];
  return std::sqrt(x * x + y * y + z * z) - (of_a.radius + of_b.radius);
}

MEDIAL_VK_INLINE ClosestBalls pair_of(const BodyTree& a, const BodyTree& b, const FloatPose& pose,
                                      const BallPair& pair) {
  if (pair.a >= a.size() || pair.b >= b.size()) return {};
  return {separation_of(a.leaf(pair.a), b.leaf(pair.b), pose), pair};
}

/// Separations as integers, each with a number below 64 in its lowest six bits. With a `bias` that makes all
/// separations positive, keys have nearly their order, as of positive floats the greater one has the greater bits. The
/// least key gives the least separation and its number in as many steps as the least separation alone.
MEDIAL_VK_INLINE EightInts keys_of(const EightFloats& separations, float bias, const EightInts& numbers) {
  return (reinterpret_cast<EightInts>(separations + bias) & ~63) | numbers;
}

/// No radius is greater than the reach of its tree, so this makes separations positive.
MEDIAL_VK_INLINE float bias_of(const NodeTree& a, const NodeTree& b) {
  return static_cast<float>(1.0001 * (a.reach() + b.reach()));
}

/// Down to an item near a point, by way of the closest ball of each node.
MEDIAL_VK_INLINE std::uint32_t item_near(const NodeTree& tree, const std::array<float, 3>& p) {
  const float bias = bias_of(tree, tree);
  const BodyNode* node = &tree.node(0);
  while (true) {
    const EightFloats x = load(node->centre[0]) - p[0], y = load(node->centre[1]) - p[1],
                      z = load(node->centre[2]) - p[2];
    const EightFloats separations = square_root(x * x + y * y + z * z) - load(node->radius);
    const std::uint32_t k =
        static_cast<std::uint32_t>(least_of(keys_of(separations, bias, EightInts{0, 1, 2, 3, 4, 5, 6, 7}))) % 64;
    if (node->is_lowest) return node->below[k];
    node = &tree.node(node->below[k]);
  }
}

/// A search for the closest two items. Pairs of nodes are compared many at a time, each step for all of them before the
/// next one: a processor computes them at the same time, as few branches depend on the results. Most pairs of the
/// lowest level are compared last, when nearly all are ruled out. Allocates nothing.
class BallSearch {
 public:
  /// Precondition: no tree is empty.
  BallSearch(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const ClosestBalls& best, float enough)
      : a_(a.nodes()), b_(b.nodes()), of_a_(a), of_b_(b), pose_(pose), enough_(enough), best_(best) {}

  const ClosestBalls& best() const { return best_; }

  /// For a first bound. Two nodes that overlap by enough most likely hold balls that do.
  MEDIAL_VK_INLINE void begin() {
    const float above = dive();
    if (is_reached() || above > enough_) return;
    OverlapSearch overlap(a_, b_, pose_, enough_);
    if (overlap.find()) best_ = pair_of(of_a_, of_b_, pose_, overlap.found());
  }

  MEDIAL_VK_INLINE void run() {
    if (is_reached()) return;
    const auto& shift = pose_.shift;
    const Task roots = {
        0, 0, {0, 0, 0, rounded_up(a_.reach())}, {shift[0], shift[1], shift[2], rounded_up(b_.reach())}};
    open(roots, stored(in_frame_of_a(b_.node(0), pose_)));
    while (!is_reached()) {
      if (!has_dived_ && count_ + lowest_count_ > kManyWithoutDive) {
        (void)dive();
      } else if (lowest_count_ < kManyLowest && count_ > 0) {
        divide_some();
      } else if (lowest_count_ > 0) {
        compare_lowest();
      } else {
        return;
      }
    }
  }

 private:
  static constexpr std::uint32_t kWidth = BodyNode::kWidth;
  static constexpr std::size_t kPairs = std::size_t{kWidth} * kWidth;
  static constexpr std::size_t kBatch = 32;       // pairs of nodes that are compared together
  static constexpr std::size_t kMostDivided = 8;  // and of those, whose nodes are then replaced
  static constexpr std::size_t kManyLowest = 64;
  static constexpr std::size_t kManyWithoutDive = 24;  // so many pairs wait only if the first bound is poor

  /// A ball around all that a node holds, in the frame of a.
  struct Around {
    float x, y, z, radius;
  };

  /// Two nodes, one of each tree, below which there may be a closer pair. Without initial values, which would take
  /// time.
  struct Task {
    std::uint32_t node_a, node_b;
    Around a, b;
  };

  MEDIAL_VK_INLINE bool is_reached() const { return best_.separation <= enough_; }

  /// Straight down to two items, by way of the closest two balls of each two nodes. The separation of the two balls
  /// around the last two nodes, roughly, or kFarther.
  MEDIAL_VK_INLINE float dive() {
    has_dived_ = true;
    const float bias = bias_of(a_, b_);
    float above = kFarther;
    std::uint32_t node_a = 0, node_b = 0;
    while (true) {
      const BodyNode &a = a_.node(node_a), &b = b_.node(node_b);
      const std::int32_t key = least_key(a, b, bias);
      const std::uint32_t k = static_cast<std::uint32_t>(key) % 64 / kWidth,
                          j = static_cast<std::uint32_t>(key) % kWidth;
      if (a.is_lowest && b.is_lowest) {
        const ClosestBalls found = pair_of(of_a_, of_b_, pose_, {a.below[k], b.below[j]});
        if (found.separation < best_.separation) best_ = found;
        return above;
      }
      above = std::bit_cast<float>(key) - bias;
      if (!a.is_lowest) node_a = a.below[k];
      if (!b.is_lowest) node_b = b.below[j];
    }
  }

  /// Of the closest two balls, with the number 8 k + j.
  MEDIAL_VK_INLINE std::int32_t least_key(const BodyNode& a, const BodyNode& b, float bias) const {
    const StoredCentres to = stored(in_frame_of_a(b, pose_));
    const EightFloats centre_x = load(a.centre[0]), centre_y = load(a.centre[1]), centre_z = load(a.centre[2]),
                      radius = load(a.radius);
    EightInts least = std::numeric_limits<std::int32_t>::max() - EightInts{};
    for (std::uint32_t j = 0; j < kWidth; ++j) {
      const EightFloats x = centre_x - to.x[j], y = centre_y - to.y[j], z = centre_z - to.z[j];
      const EightFloats separations = square_root(x * x + y * y + z * z) - (radius + b.radius[j]);
      const EightInts numbers = EightInts{0, 8, 16, 24, 32, 40, 48, 56} + static_cast<std::int32_t>(j);
      least = lesser(least, keys_of(separations, bias, numbers));
    }
    return least_of(least);
  }

  /// The pairs of balls that are closer than the best: bits 8 k + j.
  MEDIAL_VK_INLINE std::uint64_t closer_pairs(const BodyNode& a, const BodyNode& b, const StoredCentres& to) const {
    const EightFloats x = load(a.centre[0]), y = load(a.centre[1]), z = load(a.centre[2]),
                      reach = load(a.radius) + best_.separation;
    EightInts closer_to_a{};  // bit j of element k
    for (std::size_t j = 0; j < kWidth; ++j) {
      closer_to_a |= closer(x - to.x[j], y - to.y[j], z - to.z[j], reach + b.radius[j]).where & std::int32_t{1 << j};
    }
    return bytes_of(closer_to_a);
  }

  /// The next pairs of nodes above the lowest level, as many as there is room for what is below them. One at a time,
  /// the search is depth first and always has room: each level leaves up to kPairs - 1 tasks behind.
  MEDIAL_VK_INLINE void divide_some() {
    const std::size_t below = count_ + (kPairs - 1) * (a_.levels() + b_.levels()) + 1;
    const std::size_t room = (tasks_.size() - std::min(tasks_.size(), below)) / kPairs;
    const std::size_t taken = std::clamp<std::size_t>(room, 1, std::min(kMostDivided, count_));
    std::array<Task, kMostDivided> batch;
    count_ -= taken;
    std::copy_n(tasks_.data() + count_, taken, batch.data());
    compare(batch.data(), taken);
  }

  MEDIAL_VK_INLINE void compare_lowest() {
    for (std::size_t i = 0; i < lowest_count_ && !is_reached(); i += kBatch) {
      compare(lowest_.data() + i, std::min(kBatch, lowest_count_ - i));
    }
    lowest_count_ = 0;
  }

  /// Up to kBatch tasks. Only those are opened in which some ball of each node is closer than the best to the ball
  /// around the other node.
  MEDIAL_VK_INLINE void compare(const Task* tasks, std::size_t count) {
    const float reach = best_.separation;
    std::array<std::uint8_t, kBatch> near_a, near_both;
    std::array<StoredCentres, kBatch> centres;
    std::size_t near_a_count = 0, near_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const BodyNode& a = a_.node(tasks[i].node_a);
      const Around& b = tasks[i].b;
      near_a[near_a_count] = static_cast<std::uint8_t>(i);
      near_a_count += are_some_closer(load(a.centre[0]) - b.x, load(a.centre[1]) - b.y, load(a.centre[2]) - b.z,
                                      load(a.radius) + (b.radius + reach));
    }
    for (std::size_t i = 0; i < near_a_count; ++i) {
      const Task& task = tasks[near_a[i]];
      const BodyNode& b = b_.node(task.node_b);
      const EightCentres to = in_frame_of_a(b, pose_);
      near_both[near_count] = near_a[i];
      centres[near_count] = stored(to);
      near_count +=
          are_some_closer(to.x - task.a.x, to.y - task.a.y, to.z - task.a.z, load(b.radius) + (task.a.radius + reach));
    }
    for (std::size_t i = 0; i < near_count; ++i) open(tasks[near_both[i]], centres[i]);
  }

  MEDIAL_VK_INLINE static std::size_t are_some_closer(const EightFloats& x, const EightFloats& y, const EightFloats& z,
                                                      const EightFloats& reach) {
    return bits_of(closer(x, y, z, reach).where) != 0 ? 1 : 0;
  }

  /// All balls of both nodes, with the centres of those of b in the frame of a.
  MEDIAL_VK_INLINE void open(const Task& task, const StoredCentres& to) {
    const BodyNode &a = a_.node(task.node_a), &b = b_.node(task.node_b);
    const std::uint64_t pairs = closer_pairs(a, b, to);
    if (pairs == 0) return;
    if (a.is_lowest && b.is_lowest) {
      take(a, b, to, pairs);
    } else {
      divide(task, a, b, to, a.is_lowest || b.is_lowest ? without_repeats(pairs, a) : pairs);
    }
  }

  MEDIAL_VK_INLINE void take(const BodyNode& a, const BodyNode& b, const StoredCentres& to, std::uint64_t pairs) {
    for (; pairs != 0; pairs &= pairs - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(pairs));
      const std::uint32_t k = bit / kWidth, j = bit % kWidth;
      const float separation = separation_of_pair(a, k, b, j, to);
      if (separation < best_.separation) best_ = {separation, {a.below[k], b.below[j]}};
    }
  }

  /// Tasks for these pairs. Those whose separation is that of the best, but for the rounding of squares, go no further:
  /// of many equal balls all pairs would be compared. (With a node of the lowest level a pair stands for several.)
  MEDIAL_VK_INLINE void divide(const Task& task, const BodyNode& a, const BodyNode& b, const StoredCentres& to,
                               std::uint64_t pairs) {
    const bool are_lowest =
        (a.is_lowest || a_.node(a.below[0]).is_lowest) && (b.is_lowest || b_.node(b.below[0]).is_lowest);
    const float below_this = a.is_lowest || b.is_lowest ? kFarther : best_.separation;
    Task* const tasks = are_lowest ? lowest_.data() : tasks_.data();
    std::size_t& count = are_lowest ? lowest_count_ : count_;
    for (; pairs != 0; pairs &= pairs - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(pairs));
      const std::uint32_t k = bit / kWidth, j = bit % kWidth;
      Task& below = tasks[count];
      below.node_a = a.is_lowest ? task.node_a : a.below[k];
      below.node_b = b.is_lowest ? task.node_b : b.below[j];
      below.a = a.is_lowest ? task.a : Around{a.centre[0][k], a.centre[1][k], a.centre[2][k], a.radius[k]};
      below.b = b.is_lowest ? task.b : Around{to.x[j], to.y[j], to.z[j], b.radius[j]};
      count += separation_of_pair(a, k, b, j, to) < below_this ? 1 : 0;
    }
  }

  MEDIAL_VK_INLINE static float separation_of_pair(const BodyNode& a, std::uint32_t k, const BodyNode& b,
                                                   std::uint32_t j, const StoredCentres& to) {
    const float x = a.centre[0][k] - to.x[j], y = a.centre[1][k] - to.y[j], z = a.centre[2][k] - to.z[j];
    return std::sqrt(x * x + y * y + z * z) - (a.radius[k] + b.radius[j]);
  }

  const NodeTree& a_;
  const NodeTree& b_;
  const BodyTree& of_a_;
  const BodyTree& of_b_;
  const FloatPose& pose_;
  float enough_;
  ClosestBalls best_;
  bool has_dived_ = false;
  std::size_t count_ = 0, lowest_count_ = 0;
  std::array<Task, 1 + (kPairs - 1) * 2 * node_levels(kMostBodyBalls) + kPairs * kMostDivided> tasks_;
  std::array<Task, kManyLowest + kPairs * kMostDivided> lowest_;  // whose nodes are of the lowest level
};

/// From the centre of a ball of a to that of one of b, as far as its boundary, and back from there.
MEDIAL_VK_INLINE BallPair pair_between(const BodyTree& a, const BodyTree& b, const FloatPose& pose,
                                       const FloatBall& of_a, const FloatBall& of_b) {
  const std::array<float, 3> centre = pose.to_a(of_b.centre);
  std::array<float, 3> away, on_a, on_b;
  for (std::size_t i = 0; i < 3; ++i) away[i] = centre[i] - of_a.centre[i];
  const float distance = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
  const float share_a = distance > 0 ? of_a.radius / distance : 0, share_b = distance > 0 ? of_b.radius / distance : 0;
  for (std::size_t i = 0; i < 3; ++i) on_a[i] = of_a.centre[i] + share_a * away[i];
  for (std::size_t i = 0; i < 3; ++i) {
    const float back = pose.rows[0][i] * away[0] + pose.rows[1][i] * away[1] + pose.rows[2][i] * away[2];
    on_b[i] = of_b.centre[i] - share_b * back;
  }
  return {item_near(a.nodes(), on_a), item_near(b.nodes(), on_b)};
}

}  // namespace

ClosestBalls closest_balls(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start,
                           float enough, float most) {
  ClosestBalls best = pair_of(a, b, pose, start);
  if (most < best.separation) best = {most, {}};
  BallSearch search(a, b, pose, best, enough);
  const auto run = [&]() __attribute__((always_inline)) {
    if (!(best.separation < kFarther)) search.begin();
    search.run();
  };
  run_on_this_processor(run);
  return search.best();
}

BallPair balls_near(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const FloatBall& of_a,
                    const FloatBall& of_b) {
  const auto run = [&]() __attribute__((always_inline)) { return pair_between(a, b, pose, of_a, of_b); };
  return run_on_this_processor(run);
}

}  // namespace medial_vk
