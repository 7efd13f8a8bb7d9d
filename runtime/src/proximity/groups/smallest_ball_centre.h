// About the centre of the smallest ball around balls.
#pragma once

#include <cstddef>

#include "base/point_ops.h"

namespace medial_vk {

/// Starts at a point near the balls; step i goes the share 1/(i + 1) of the way to the farthest point of a ball
/// (M. Badoiu and K. Clarkson, "Smaller core-sets for balls", 2003). `for_balls(visit)` calls visit(centre, radius) for
/// each ball.
template <class ForBalls>
Point near_smallest_ball_centre(Point middle, std::size_t steps, const ForBalls& for_balls) {
  for (std::size_t i = 1; i <= steps; ++i) {
    double farthest = -1;
    Point there = middle;
    for_balls([&](const Point& centre, double radius) {
      const Point away = centre - middle;
      const double distance = length(away), reach = distance + radius;
      if (reach <= farthest) return;
      farthest = reach;
      there = distance > 0 ? middle + (reach / distance) * away : middle;
    });
    middle = middle + (1.0 / static_cast<double>(i + 1)) * (there - middle);
  }
  return middle;
}

}  // namespace medial_vk
