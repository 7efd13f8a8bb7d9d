// A tree of balls, in float, eight balls side by side: docs/theory.md, "Distances".
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/loop_watch.h"
#include "base/point_ops.h"

namespace medial_vk {

/// Relative to the centre of a body.
struct FloatBall {
  std::array<float, 3> centre = {0, 0, 0};
  float radius = 0;
  /// Of a ball that holds triangles: radius - excess is the radius of a ball of the same centre in the solid, or, where
  /// none is known, -radius. Every point p is at most at |p - centre| - (radius - excess) from the solid.
  float excess = 0;

  bool operator==(const FloatBall&) const = default;
};

inline Point point_of(const FloatBall& ball) { return {ball.centre[0], ball.centre[1], ball.centre[2]}; }

/// A ball of radius 0 at the nearest point in float.
inline FloatBall float_ball_at(const Point& p) {
  return {{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}, 0};
}

/// In float, and at least the true value of a quantity that was computed in double with fewer than eight roundings.
float rounded_up(double x);

/// Of a slot without a ball: so far below 0 that nothing is near it.
constexpr float kUnusedRadius = -3e38f;

/// Up to eight balls, each with what it holds: a node below, or, in a node of the lowest level, one item.
struct alignas(32) BodyNode {
  static constexpr std::size_t kWidth = 8;

  std::array<std::array<float, kWidth>, 3> centre = {};
  std::array<float, kWidth> radius = {};         ///< Of an unused slot: kUnusedRadius.
  std::array<float, kWidth> excess = {};         ///< Used by searches among triangles only.
  std::array<std::uint32_t, kWidth> below = {};  ///< Index of an item or of a node.
  std::uint32_t count = 0;                       ///< Of used slots, which are the first.
  bool is_lowest = true;
};

/// The number of levels of nodes above `count` items, at least one.
constexpr std::size_t node_levels(std::size_t count) {
  std::size_t levels = 1;
  for (; count > BodyNode::kWidth; count = (count + BodyNode::kWidth - 1) / BodyNode::kWidth) ++levels;
  return levels;
}

/// Nodes over items. All nodes of the lowest level are on one level.
class NodeTree {
 public:
  /// A ball that holds the items with these indices. Called from several threads at once.
  using BallAround = std::function<FloatBall(std::span<const std::uint32_t> items)>;

  /// Items are grouped by their positions; with radii, as balls, into tighter groups, which takes a tenth of a
  /// millisecond for each. No item, no node. The tree does not depend on the number of threads (0: one per core).
  /// Throws LoopStopped if `watch` is stopped; null: it runs to its end.
  static NodeTree build(std::span<const Point> positions, const BallAround& ball_around, unsigned threads,
                        std::span<const double> radii = {}, LoopWatch* watch = nullptr);

  bool is_empty() const { return nodes_.empty(); }
  std::size_t size() const { return nodes_.size(); }
  std::size_t levels() const { return levels_; }  ///< Of nodes.
  /// Node 0 is the root.
  const BodyNode& node(std::uint32_t i) const { return nodes_[i]; }
  /// No point of a ball in the tree is farther from the origin.
  double reach() const { return reach_; }

 private:
  struct Builder;

  std::vector<BodyNode> nodes_;
  std::size_t levels_ = 0;
  double reach_ = 0;
};

}  // namespace medial_vk
