// Convex polygons in space, cut by planes.
#pragma once

#include <array>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk::bench {

using Polygon = std::vector<Point>;

/// Cuts off the part with normal * p > height (Sutherland and Hodgman 1974). Points on the plane remain.
void cut_off(Polygon& polygon, const Point& normal, double height);

/// Of a box and a triangle, both closed.
bool meets_box(const std::array<Point, 3>& triangle, const Point& lower, const Point& upper);

}  // namespace medial_vk::bench
