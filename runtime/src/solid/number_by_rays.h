// Winding numbers at points off a closed surface, by rays in several directions.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

#include "medial_vk/bvh.h"

namespace medial_vk {

/// The winding number at `p` of the surface that the triangles of all trees form together, which is closed: an integer.
/// No value: each ray passes an edge, or `p` lies on a triangle.
std::optional<std::int64_t> number_by_rays(std::initializer_list<const Bvh*> trees, const Point& p);

}  // namespace medial_vk
