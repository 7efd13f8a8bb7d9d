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

/// How much nearer the ball is than `from` to the point at `distance` from there along a unit direction. Of a ball that
/// is far from that point, this is the height of its top; of one close to it, height_over().
inline double nearer_than(const Ball& ball, const Point& from, const Point& direction, double distance) {
  return std::max(0.0, distance + ball.radius - length(from + distance * direction - ball.centre));
}

/// An element of the boundary, over which balls have columns: along the normal of a triangle, or, if there is a
/// distance, towards the point outside of a probe.
struct Column {
  Point from, direction;
  double distance;

  double height(const Ball& ball) const {
    return distance > 0 ? nearer_than(ball, from, direction, distance) : height_over(ball, from, direction);
  }
  /// Over a unit of area: the volume, or for a probe the height. `ease` is a length: shorter columns count as straight,
  /// longer ones as widening.
  double cost(double height, double ease) const {
    if (distance > 0) return height;
    const double spread = height / ease;
    return height * (1 + spread + spread * spread / 3);
  }
};

}  // namespace medial_vk
