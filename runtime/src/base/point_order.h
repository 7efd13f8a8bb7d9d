// An order of scattered points in which most neighbours in space are neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Indices of the points along a Z-order curve of 1024^3 cells in their box; equal cells by index. Fewer than 2^32
/// points. The position of points with coordinates that are not finite is arbitrary.
std::vector<std::uint32_t> order_along_curve(std::span<const Point> points);

/// Indices of the points in `order`, halved recursively along the longest side of their box: slower, but insensitive to
/// the distribution of the points and to outliers. Finite coordinates only.
void order_by_halving(std::span<const Point> points, std::vector<std::uint32_t>& order);

}  // namespace medial_vk
