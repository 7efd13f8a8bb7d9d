// The measure in the search for covers: columns between an element of the boundary and the sphere of a ball.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// The factor by which radii are enlarged, so that balls hold their elements for any rounding of distances.
inline constexpr double kCoverRoom = 1 + 1e-13;

/// The reach of the ball from a point in it along a unit direction.
inline double height_over(const Ball& ball, const Point& from, const Point& direction) {
  const Point w = from - ball.centre;
  const double along = dot(w, direction);
  return std::max(0.0, std::sqrt(std::max(0.0, along * along + ball.radius * ball.radius - dot(w, w))) - along);
}

}  // namespace medial_vk
