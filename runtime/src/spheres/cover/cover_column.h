// What the search for covers counts by: columns between a piece of the boundary and where a ball ends.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// A radius is this much larger than it need be: what is held stays so however the distance is computed.
inline constexpr double kCoverRoom = 1 + 1e-13;

/// How far the ball reaches from a point in it along a direction of length 1.
inline double height_over(const Ball& ball, const Point& from, const Point& direction) {
  const Point w = from - ball.centre;
  const double along = dot(w, direction);
  return std::max(0.0, std::sqrt(std::max(0.0, along * along + ball.radius * ball.radius - dot(w, w))) - along);
}

}  // namespace medial_vk
