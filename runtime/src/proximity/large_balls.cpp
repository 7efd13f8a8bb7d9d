#include "proximity/large_balls.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace medial_vk {

LargeBalls::LargeBalls(const BodyTree& tree) {
  std::vector<double> by(tree.size());
  for (std::uint32_t i = 0; i < tree.size(); ++i) by[i] = tree.leaf(i).radius;
  for (std::size_t n = 0; n < std::min(tree.size(), kNodes * BodyNode::kWidth); ++n) {
    const auto next = static_cast<std::uint32_t>(std::max_element(by.begin(), by.end()) - by.begin());
    const FloatBall& ball = tree.leaf(next);
    BodyNode& node = nodes_[n / BodyNode::kWidth];
    for (std::size_t axis = 0; axis < 3; ++axis) node.centre[axis][node.count] = ball.centre[axis];
    node.radius[node.count++] = ball.radius;
    for (std::uint32_t i = 0; i < tree.size(); ++i) {
      const FloatBall& other = tree.leaf(i);
      const double apart = length(point_of(other) - point_of(ball));
      by[i] = std::min(by[i], apart + other.radius - ball.radius);
    }
    by[next] = -std::numeric_limits<double>::infinity();
  }
}

}  // namespace medial_vk
