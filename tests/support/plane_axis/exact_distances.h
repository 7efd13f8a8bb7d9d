// Distances in the plane by brute force, and points of the exact axis that are found by bisection.
#pragma once

#include <optional>
#include <random>

#include "medial_vk/plane_axis.h"

namespace medial_vk::test {

struct NearestPoint {
  double distance = 0;
  PlanePoint foot = {};
};

NearestPoint nearest_point(const PreparedShape& shape, const PlanePoint& x);
/// By the winding number.
bool is_inside(const PreparedShape& shape, const PlanePoint& x);
/// From x to the arcs and nodes of an axis.
double distance_to_axis(const PlaneAxis& axis, const PlanePoint& x);

/// A point of the exact axis, to a few roundings, and its object angle.
struct AxisSample {
  PlanePoint point = {};
  double radius = 0, object_angle = 0;
};

/// On a short random segment, if the nearest boundary point jumps there: where it turns most is bisected.
std::optional<AxisSample> axis_sample(const PreparedShape& shape, PlaneSide side, std::mt19937_64& random);

}  // namespace medial_vk::test
