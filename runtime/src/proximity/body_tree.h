// A tree over a set of balls of a body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "proximity/node_tree.h"

namespace medial_vk {

class BodyTree {
 public:
  /// Of balls, relative to `centre`.
  static BodyTree build(std::span<const Ball> balls, const Point& centre);

  bool is_empty() const { return nodes_.is_empty(); }
  const NodeTree& nodes() const { return nodes_; }
  std::size_t size() const { return leaves_.size(); }
  /// Holds ball `i` of the set; the smallest such ball, up to rounding.
  const FloatBall& leaf(std::uint32_t i) const { return leaves_[i]; }

 private:
  FloatBall ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) const;

  Point centre_ = {0, 0, 0};
  NodeTree nodes_;
  std::vector<FloatBall> leaves_;
};

}  // namespace medial_vk
