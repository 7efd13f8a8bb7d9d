// Preparation: any triangles become a mesh that can be searched, with a report of the assumptions that were made.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Merges equal vertices, drops degenerate and duplicate faces and unused vertices, makes the orientation of each
/// component consistent (and outward, if the whole mesh is inside out), and determines which normals can be trusted.
/// `threads`: of the host, 0: one per core; the result does not depend on it. Does not throw. Errors: kInvalidMesh (an
/// index out of range, a coordinate that is not finite; nothing is left, or nothing is enclosed), kOutOfMemory.
Result<PreparedMesh> prepare_mesh(Mesh mesh, unsigned threads = 0);

/// Moves every vertex by a seeded random vector of length up to `amplitude` times the longest side (2.4.4), and
/// prepares the mesh again, as moved faces may cross. Corners that coincide move together. The report covers both
/// preparations. Errors: those of prepare_mesh().
Result<PreparedMesh> perturb_mesh(PreparedMesh mesh, double amplitude, std::uint64_t seed, unsigned threads = 0);

}  // namespace medial_vk
