#include "bounding_ball.h"

#include <algorithm>

#include "base/point_ops.h"
#include "proximity/groups/smallest_ball_centre.h"

namespace medial_vk::bench {

BoundingBall BoundingBall::around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  const Ball& first = balls[chosen.front()];
  if (chosen.size() == 1) return {first.centre, first.radius};
  constexpr std::size_t kSteps = 1024;  // within a thousandth of the smallest radius
  BoundingBall ball;
  ball.centre = near_smallest_ball_centre(first.centre, kSteps, [&](const auto& visit) {
    for (const std::uint32_t i : chosen) visit(balls[i].centre, balls[i].radius);
  });
  for (const std::uint32_t i : chosen) {
    ball.radius = std::max(ball.radius, length(balls[i].centre - ball.centre) + balls[i].radius);
  }
  return ball;
}

}  // namespace medial_vk::bench
