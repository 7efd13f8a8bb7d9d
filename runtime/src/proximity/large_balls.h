// A few large balls of a set that lie far apart: most bodies that overlap do so by these.
#pragma once

#include <array>

#include "proximity/body_tree.h"
#include "proximity/node_tree.h"

namespace medial_vk {

class LargeBalls {
 public:
  static constexpr std::size_t kNodes = 2;

  LargeBalls() = default;
  /// Each ball in turn is the one that reaches farthest out of those before it.
  explicit LargeBalls(const BodyTree& tree);

  const std::array<BodyNode, kNodes>& nodes() const { return nodes_; }
  /// Holds all of them.
  const FloatBall& around() const { return around_; }

 private:
  std::array<BodyNode, kNodes> nodes_ = {};
  FloatBall around_ = {};
};

}  // namespace medial_vk
