// Proofs that hulls of balls, of any origin, lie inside a solid (docs/theory.md, "Hulls of balls").
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "medial_vk/ball_hull.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_proofs.h"

namespace medial_vk {

/// The proof that hulls lie inside a solid: for each a point that is inside, and planes between it and every triangle.
struct HullProof {
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  std::uint32_t first_failure = 0;  ///< Index of a hull, if any failed.
  std::uint64_t planes = 0;         ///< Of all hulls, each for a triangle or for a box that holds several.
  /// The least amount, in mesh units, by which all radii of one hull had to be smaller for its proof, of the worst hull
  /// that failed; 0 if none did. Infinite if no radii would do.
  double greatest_lack = 0;

  bool proved() const { return failed == 0; }
};

/// Tests, in double precision and from the numbers of the hulls alone, that every hull lies in the solid that the mesh
/// encloses. Time: some 0.3 ms a hull. Errors: kUsage (more than 2^20 hulls, a hull without balls or of more than
/// three, a number that is not finite or beyond 1e18, a negative radius; names the hull), kOutOfMemory, kInterrupted.
Result<HullProof> prove_hulls(const IndexedMesh& mesh, std::span<const BallHull> hulls,
                              const ProofOptions& options = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
