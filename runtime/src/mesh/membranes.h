// Open, flat parts of a mesh, which enclose nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// By component: 1 for a *membrane* (docs/theory.md, "Membranes"). It is open and has a triangle that crosses others.
/// Beside the middles of its triangles its own winding number is about 0, that of all components of this kind is small,
/// and the number of the rest is clearly that of the inside or of the outside. Triangles are oriented as the sides were
/// decided. `crossed`: by triangle.
std::vector<char> find_membranes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                 const std::vector<bool>& crossed, unsigned threads);

}  // namespace medial_vk
