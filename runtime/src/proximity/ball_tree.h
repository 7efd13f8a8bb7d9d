// A tree over balls, in float, eight balls side by side: docs/theory.md, "Distances".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk {

/// Relative to the centre of a body.
struct FloatBall {
  std::array<float, 3> centre = {0, 0, 0};
  float radius = 0;
};

/// Up to eight balls, each with what it holds: the balls of a node below, or one ball of the set.
struct alignas(32) BallNode {
  static constexpr std::size_t kWidth = 8;

  std::array<std::array<float, kWidth>, 3> centre;
  std::array<float, kWidth> radius;  ///< Of an unused place: below all others, so that it is far from everything.
  std::array<std::uint32_t, kWidth> below;  ///< BallTree::kLeaf | index of a ball, or index of a node.

  FloatBall ball(std::size_t k) const { return {{centre[0][k], centre[1][k], centre[2][k]}, radius[k]}; }
};

class BallTree {
 public:
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;

  /// Of balls, relative to `centre`. No ball, no node.
  static BallTree build(std::span<const Ball> balls, const Point& centre);

  bool is_empty() const { return nodes_.empty(); }
  /// Node 0 is the root, inside root_ball().
  const BallNode& node(std::uint32_t i) const { return nodes_[i]; }
  const FloatBall& root_ball() const { return root_ball_; }
  std::size_t size() const { return leaves_.size(); }
  /// Holds ball `i` of the set; the smallest such ball, up to rounding.
  const FloatBall& leaf(std::uint32_t i) const { return leaves_[i]; }
  /// No point of a ball in the tree is farther from the centre.
  double reach() const { return reach_; }

 private:
  std::uint32_t build_node(std::span<const Ball> balls, std::span<std::uint32_t> of_node);
  FloatBall ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> of_node) const;

  Point centre_ = {0, 0, 0};
  std::vector<BallNode> nodes_;
  std::vector<FloatBall> leaves_;
  FloatBall root_ball_;
  double reach_ = 0;
};

/// The number of levels of nodes above `count` balls.
constexpr std::size_t ball_tree_levels(std::size_t count) {
  std::size_t levels = 1;
  for (; count > BallNode::kWidth; count = (count + BallNode::kWidth - 1) / BallNode::kWidth) ++levels;
  return levels;
}

}  // namespace medial_vk
