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

  bool operator==(const FloatBall&) const = default;
};

/// Up to eight balls, each with what it holds: a node below, or, in a node of the lowest level, one ball of the set.
struct alignas(32) BodyNode {
  static constexpr std::size_t kWidth = 8;

  std::array<std::array<float, kWidth>, 3> centre = {};
  std::array<float, kWidth> radius = {};         ///< Of an unused slot: so far below 0 that nothing is near it.
  std::array<std::uint32_t, kWidth> below = {};  ///< Index of a ball or of a node.
  std::uint32_t count = 0;                       ///< Of used slots, which are the first.
  bool is_lowest = true;
};

class BodyTree {
 public:
  /// Of balls, relative to `centre`. No ball, no node.
  static BodyTree build(std::span<const Ball> balls, const Point& centre);

  bool is_empty() const { return nodes_.empty(); }
  /// Node 0 is the root. All nodes without nodes below are on one level.
  const BodyNode& node(std::uint32_t i) const { return nodes_[i]; }
  std::size_t size() const { return leaves_.size(); }
  /// Holds ball `i` of the set; the smallest such ball, up to rounding.
  const FloatBall& leaf(std::uint32_t i) const { return leaves_[i]; }
  /// No point of a ball in the tree is farther from the centre.
  double reach() const { return reach_; }

 private:
  std::uint32_t build_node(std::span<const Ball> balls, std::span<std::uint32_t> of_node, std::size_t levels);
  FloatBall ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> of_node) const;

  Point centre_ = {0, 0, 0};
  std::vector<BodyNode> nodes_;
  std::vector<FloatBall> leaves_;
  double reach_ = 0;
};

/// The number of levels of nodes above `count` balls, at least one.
constexpr std::size_t body_tree_levels(std::size_t count) {
  std::size_t levels = 1;
  for (; count > BodyNode::kWidth; count = (count + BodyNode::kWidth - 1) / BodyNode::kWidth) ++levels;
  return levels;
}

}  // namespace medial_vk
