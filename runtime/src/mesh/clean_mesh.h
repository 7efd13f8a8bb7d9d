// Cleaning: from the triangles of a file to triangles that the other steps can handle.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Merges vertices at exactly the same position (0 and -0 are the same) into the first of them, in the order of first
/// ones. Returns, by old vertex, the new one.
std::vector<std::uint32_t> merge_equal_vertices(Mesh& mesh);

/// Merges equal vertices, drops degenerate and duplicate triangles and unused vertices; fills the counts of the report
/// and the two maps of PreparedMesh. Indices must be valid, coordinates finite.
void clean_mesh(PreparedMesh& prepared);

}  // namespace medial_vk
