// Open parts of a mesh that enclose nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// The winding number of an open, flat surface is between -1/2 and 1/2, so it encloses nothing. Beside a triangle,
/// without that triangle, it is 0. This is the greatest absolute value for a surface that counts as flat.
constexpr double kFlat = 0.1;

/// By component: 1 for a *membrane*, an open component that is flat and to whose triangles all flat components together
/// add little. None if all are. Triangles are oriented as the sides were decided.
std::vector<char> find_membranes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of, unsigned threads);

}  // namespace medial_vk
