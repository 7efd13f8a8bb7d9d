#include "proximity/body_tree.h"

#include <algorithm>

#include "proximity/groups/smallest_ball_centre.h"

namespace medial_vk {
namespace {

/// Trees over so many balls get tighter groups, within a second.
constexpr std::size_t kMostTightened = 8192;

Point middle_of(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  const std::size_t steps = chosen.size() <= 4096 ? 128 : 32;
  return near_smallest_ball_centre(balls[chosen.front()].centre, steps, [&](const auto& visit) {
    for (const std::uint32_t i : chosen) visit(balls[i].centre, balls[i].radius);
  });
}

}  // namespace

BodyTree BodyTree::build(std::span<const Ball> balls, const Point& centre) {
  BodyTree tree;
  tree.centre_ = centre;
  tree.leaves_.reserve(balls.size());
  std::vector<Point> centres;
  std::vector<double> radii;
  centres.reserve(balls.size());
  for (const Ball& ball : balls) {
    const Point relative = ball.centre - centre;
    FloatBall leaf = float_ball_at(relative);
    leaf.radius = rounded_up(ball.radius + length(relative - point_of(leaf)) + 0x1p-52 * length(relative));
    tree.leaves_.push_back(leaf);
    centres.push_back(ball.centre);
    if (balls.size() <= kMostTightened) radii.push_back(ball.radius);
  }
  constexpr unsigned kOneThread = 1;  // few balls
  tree.nodes_ = NodeTree::build(
      centres, [&](std::span<const std::uint32_t> chosen) { return tree.ball_around(balls, chosen); }, kOneThread,
      radii);
  return tree;
}

/// Holds all chosen leaves, as they are in float. Of equal leaves it is the leaf: a larger ball would be closer to
/// other balls than any of them, so that no search could pass over it.
FloatBall BodyTree::ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) const {
  const FloatBall& first = leaves_[chosen.front()];
  if (std::ranges::all_of(chosen, [&](std::uint32_t i) { return leaves_[i] == first; })) return first;
  FloatBall ball = float_ball_at(middle_of(balls, chosen) - centre_);
  const Point middle = point_of(ball);
  double radius = 0;
  for (const std::uint32_t i : chosen) {
    radius = std::max(radius, length(point_of(leaves_[i]) - middle) + leaves_[i].radius);
  }
  ball.radius = rounded_up(radius);
  return ball;
}

}  // namespace medial_vk
