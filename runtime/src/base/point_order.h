// An order of scattered points in which neighbours in space are mostly neighbours in the order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Indices of the points along a Z-order curve of 1024^3 cells in their box; equal cells by index. Fewer than 2^32
/// points. Coordinates that are not finite come anywhere.
std::vector<std::uint32_t> order_along_curve(std::span<const Point> points);

/// Indices of the points, halved along the longest side of their box again and again: slower, but wherever most of them
/// are, neighbours are found, and one far away spoils nothing. Finite coordinates only.
std::vector<std::uint32_t> order_by_halving(std::span<const Point> points);

}  // namespace medial_vk
