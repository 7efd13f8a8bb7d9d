#include "proximity/large_balls.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "proximity/groups/smallest_ball_centre.h"

namespace medial_vk {
namespace {

constexpr std::size_t kStepsAroundLarge = 128;

FloatBall ball_around(std::span<const FloatBall> balls) {
  FloatBall ball =
      float_ball_at(near_smallest_ball_centre(point_of(balls.front()), kStepsAroundLarge, [&](const auto& visit) {
        for (const FloatBall& of_set : balls) visit(point_of(of_set), static_cast<double>(of_set.radius));
      }));
  double radius = 0;
  for (const FloatBall& of_set : balls) {
    radius = std::max(radius, length(point_of(of_set) - point_of(ball)) + of_set.radius);
  }
  ball.radius = rounded_up(radius);
  return ball;
}

}  // namespace

LargeBalls::LargeBalls(const BodyTree& tree) {
  for (BodyNode& node : nodes_) node.radius.fill(kUnusedRadius);
  std::vector<double> by(tree.size());
  for (std::uint32_t i = 0; i < tree.size(); ++i) by[i] = tree.leaf(i).radius;
  std::vector<FloatBall> chosen;
  chosen.reserve(kNodes * BodyNode::kWidth);
  for (std::size_t n = 0; n < std::min(tree.size(), kNodes * BodyNode::kWidth); ++n) {
    const auto next = static_cast<std::uint32_t>(std::max_element(by.begin(), by.end()) - by.begin());
    const FloatBall& ball = tree.leaf(next);
    chosen.push_back(ball);
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
  if (!chosen.empty()) around_ = ball_around(chosen);
}

}  // namespace medial_vk
