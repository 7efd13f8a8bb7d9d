// How the winding number of a closed mesh changes on the way from one triangle to another: by what lies between them.
#pragma once

#include <cstdint>
#include <optional>

#include "mesh/triangle_tree.h"

namespace medial_vk {

/// WindingTree::beside at place `to` minus that at place `from`, for a closed mesh: an integer, exact. A way between
/// the two triangles adds 1 where it goes into the surface and takes 1 away where it comes out. Nothing if rounding
/// leaves a crossing in doubt on each of some ways that were tried. Adds the boxes and triangles that were looked at to
/// `cost`.
std::optional<int> winding_step(const TriangleTree& tree, std::uint32_t from, std::uint32_t to, std::uint64_t& cost);

}  // namespace medial_vk
