// Proofs that given balls lie inside a solid, or cover it, of any origin (docs/theory.md, "Tight spheres").
#pragma once

#include <span>
#include <stop_token>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

struct ProofOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

struct SphereProofs {
  InsideProof inside;
  CoverProof cover;
};

/// Tests, in double precision and from the numbers of the balls alone, that every ball of `inside` lies in the solid
/// that the mesh encloses, and that no point of the solid or of the mesh is outside the balls of `cover`. fit_spheres()
/// has the same proofs; balls from elsewhere, such as a file, need them before a Body is made of them. Either set may
/// be empty: no ball proves nothing about `inside`, and leaves every triangle uncovered. Inside an open mesh are the
/// points whose winding number is at least 1/2; a Body takes an open mesh for its surface, in which no ball lies. Time:
/// some microseconds a ball and a triangle. Errors: kUsage (more than 2^24 balls, or a number that is not finite or
/// beyond 1e18; names the set), kOutOfMemory, kInterrupted; those of measure_ball_union().
Result<SphereProofs> prove_spheres(const IndexedMesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover,
                                   const ProofOptions& options = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
