#include "proximity/placed/placed_balls.h"

namespace medial_vk {
namespace {

template <class PlaceBall, class PlaceNodeBall>
PlacedBalls placed(const BodyTree& tree, std::span<const Ball> balls, const PlaceBall& place_ball,
                   const PlaceNodeBall& place_node_ball) {
  PlacedBalls out;
  out.balls.reserve(balls.size());
  for (const Ball& ball : balls) out.balls.push_back(place_ball(ball));
  out.nodes.resize(tree.nodes().size());
  for (std::uint32_t i = 0; i < out.nodes.size(); ++i) {
    const BodyNode& from = tree.nodes().node(i);
    PlacedNode& to = out.nodes[i];
    to.below = from.below;
    to.count = from.count;
    to.is_lowest = from.is_lowest;
    for (std::uint32_t k = 0; k < from.count; ++k) {
      const Point centre = {from.centre[0][k], from.centre[1][k], from.centre[2][k]};
      to.balls[k] = place_node_ball(Ball{centre, from.radius[k]});
    }
  }
  return out;
}

}  // namespace

PlacedBalls place_a(const BodyTree& tree, std::span<const Ball> balls, const Placement& placement) {
  return placed(
      tree, balls,
      [&](const Ball& ball) {
        return Ball{ball.centre - placement.centre_a(), ball.radius};
      },
      [](const Ball& ball) { return ball; });
}

PlacedBalls place_b(const BodyTree& tree, std::span<const Ball> balls, const Placement& placement) {
  constexpr double kLarger = 1 + QueryFrame::kStretch;
  const Pose of_trees = {placement.pose().rotation, placement.shift()};
  return placed(
      tree, balls,
      [&](const Ball& ball) {
        return Ball{placement.pose() * ball.centre - placement.centre_a(), kLarger * ball.radius};
      },
      [&](const Ball& ball) {
        return Ball{of_trees * ball.centre, kLarger * ball.radius};
      });
}

bool comes_near(const PlacedBalls& set, const Ball& ball, double margin) {
  if (set.nodes.empty()) return false;
  const auto is_near = [&](const Ball& other, double by) {
    return length(other.centre - ball.centre) < other.radius + ball.radius + by;
  };
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const PlacedNode& node = set.nodes[open.back()];
    open.pop_back();
    for (std::uint32_t k = 0; k < node.count; ++k) {
      if (!is_near(node.balls[k], std::max(margin, 0.0))) continue;
      if (!node.is_lowest) {
        open.push_back(node.below[k]);
      } else if (is_near(set.balls[node.below[k]], margin)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace medial_vk
