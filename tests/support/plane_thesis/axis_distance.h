// Where an exact medial axis in the plane is, for points and segments near it.
#pragma once

#include "medial_vk/plane_axis.h"

namespace medial_vk::test {

/// From x to the nearest point of the axis.
double distance_to_axis(const PlaneAxis& axis, PlanePoint x);

/// Whether an arc crosses the segment from a to b, or comes within 1e-9 of it.
bool crosses_axis(const PlaneAxis& axis, PlanePoint a, PlanePoint b);

}  // namespace medial_vk::test
