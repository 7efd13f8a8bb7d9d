#include "ball_unions/unions/split_balls.h"

#include <cfloat>
#include <cmath>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kBallsOfBlock = 4096;
constexpr double kRounding = 0x1p-24;  // of a float

/// The rounded number as kept by devices that flush tiny numbers.
float rounded(double x) {
  const auto nearest = static_cast<float>(x);
  return std::fabs(nearest) < FLT_MIN ? 0.0f : nearest;
}

/// Splits the largest float part off x.
float take_part(double& x) {
  const float part = rounded(x);
  x -= double{part};
  return part;
}

float rounded_up(double x) { return std::nextafter(rounded(x), FLT_MAX); }
float rounded_down(double x) { return std::nextafter(rounded(x), -FLT_MAX); }

gpu::vec4 vector(const Point& p, float w) { return {rounded(p[0]), rounded(p[1]), rounded(p[2]), w}; }

gpu::BallNode split_node(const BallTree::Node& node) {
  gpu::BallNode out{};
  if (node.radius < 0) {
    out.middle_high.w = -1;
    return out;
  }
  Point rest = node.middle;
  out.middle_high = {take_part(rest[0]), take_part(rest[1]), take_part(rest[2]), rounded_up(node.size)};
  // The slope's product with a position in the box is rounded, and so is the slope: less than 8 roundings of its size.
  double least = node.least - 0x1p-40;
  for (std::size_t k = 0; k < 3; ++k) least -= 8 * kRounding * std::fabs(node.slope[k]) * node.half[k];
  out.middle_low = vector(rest, rounded_down(least));
  out.axis_0 = vector(node.axes[0], rounded_up(node.half[0]));
  out.axis_1 = vector(node.axes[1], rounded_up(node.half[1]));
  out.axis_2 = vector(node.axes[2], rounded_up(node.half[2]));
  out.slope = vector(node.slope, 0);
  return out;
}

}  // namespace

SplitBalls split_balls(std::span<const Ball> balls, std::span<const std::uint32_t> order) {
  SplitBalls out;
  out.balls.resize(order.size());
  const auto split = [&](double x, float& high, float& middle, float& low) {
    high = take_part(x);
    middle = take_part(x);
    low = take_part(x);
    out.exact = out.exact && x == 0;
  };
  for (std::size_t n = 0; n < order.size(); ++n) {
    const auto& [centre, radius] = balls[order[n]];
    gpu::SplitBall& ball = out.balls[n];
    split(centre[0], ball.high.x, ball.middle.x, ball.low.x);
    split(centre[1], ball.high.y, ball.middle.y, ball.low.y);
    split(centre[2], ball.high.z, ball.middle.z, ball.low.z);
    split(radius, ball.high.w, ball.middle.w, ball.low.w);
  }
  return out;
}

std::vector<gpu::BallNode> split_nodes(const BallTree& tree, unsigned threads) {
  std::vector<gpu::BallNode> out(tree.node_count());
  parallel_blocks(out.size(), kBallsOfBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) out[k] = split_node(tree.node(static_cast<std::uint32_t>(k)));
  });
  return out;
}

}  // namespace medial_vk
