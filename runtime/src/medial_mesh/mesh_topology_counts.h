// Counts and marks derived from the edges and triangles of a medial mesh.
#pragma once

#include <cstddef>

#include "medial_vk/medial_mesh.h"

namespace medial_vk {

/// Sorts triangles and edges and fills in the rest of `mesh` except for its hosted points, whose number is an input.
/// Precondition: the sides of the triangles are edges. Error: kOutOfMemory.
[[nodiscard]] Status complete_medial_mesh(std::size_t points, const Sheets& sheets, MedialMesh& mesh);

}  // namespace medial_vk
