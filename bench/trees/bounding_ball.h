// A ball around balls, as a bounding volume.
#pragma once

#include <cstdint>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"

namespace medial_vk::bench {

struct BoundingBall {
  Point centre = {0, 0, 0};
  double radius = 0;

  /// About the smallest ball that holds the chosen balls; exactly the ball if one is chosen. Precondition: one or more.
  static BoundingBall around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen);
  /// Searches divide the larger of two volumes.
  double size() const { return radius; }
};

/// Between the balls, less than 0 if they overlap; `pose` takes the frame of `b` to that of `a`.
double separation(const BoundingBall& a, const BoundingBall& b, const Pose& pose);

}  // namespace medial_vk::bench
