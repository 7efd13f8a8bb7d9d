// Points of two balls that prove the upper end of an interval by balls.
#pragma once

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"

namespace medial_vk::cli {

struct PointsOfBalls {
  Point on_a = {0, 0, 0}, on_b = {0, 0, 0};
};

/// The points of two balls that are nearest to the other one; where the balls overlap, one common point.
PointsOfBalls nearest_of_balls(const Ball& a, const Ball& b);

/// Bounds as a distance, with the points of the balls inside that give the upper end, in the frame of a: they are
/// `upper` apart, up to rounding, and the same point for a hit. Without such balls no coordinate is a number.
Distance distance_by_balls(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& bounds);

}  // namespace medial_vk::cli
