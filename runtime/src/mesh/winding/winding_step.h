// The difference of the winding numbers of a closed mesh at two triangles, by the triangles crossed between them.
#pragma once

#include <cstdint>
#include <optional>

#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

/// WindingTree::beside at position `to` minus that at position `from`, for a closed mesh: an integer, exact. A path
/// between the two triangles adds 1 where it enters the surface and subtracts 1 where it leaves. No value if rounding
/// leaves a crossing undecided on each of the paths tried. Adds the number of boxes and triangles tested to `cost`.
std::optional<int> winding_step(const TriangleTree& tree, std::uint32_t from, std::uint32_t to, std::uint64_t& cost);

}  // namespace medial_vk
