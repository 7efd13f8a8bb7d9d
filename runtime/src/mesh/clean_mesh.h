// From what a file holds to triangles that can be worked with.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Makes vertices at exactly the same place one (0 and -0 are the same); the first stays where it is in the order.
/// Returns, by old vertex, the new one.
std::vector<std::uint32_t> merge_equal_vertices(Mesh& mesh);

/// Merges equal vertices, drops degenerate and duplicate triangles and unused vertices; fills the counts of the report
/// and the two maps of PreparedMesh. Indices must be valid, coordinates finite.
void clean_mesh(PreparedMesh& prepared);

}  // namespace medial_vk
