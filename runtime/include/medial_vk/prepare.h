// Preparation: from any triangles to a mesh that can be searched, and what had to be assumed on the way.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Drops degenerate and duplicate faces, unused vertices excluded from the bounding box, makes each component's
/// orientation consistent (and outward if the whole mesh is inside out), inspects, sets the flags.
/// Errors: kInvalidMesh if nothing is left, or nothing is enclosed.
Result<PreparedMesh> prepare_mesh(Mesh mesh);

/// Moves every vertex by a seeded random vector of length up to `amplitude` times the longest side (2.4.4).
void perturb_mesh(Mesh& mesh, double amplitude, std::uint64_t seed);

}  // namespace medial_vk
