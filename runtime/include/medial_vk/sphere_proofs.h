// Proofs that balls of any origin lie inside a solid, or cover it, and how far its boundary is from them
// (docs/theory.md, "Tight spheres").
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

/// Bounds of the greatest distance from a point of the boundary to the balls, in mesh units: 0 if they hold it. They
/// differ by at most a thousandth of the diagonal of the mesh's box, unless its triangles need more than two million
/// parts. Balls of radius 0 are left out. Time: some milliseconds per thousand triangles. Errors: kUsage (no ball with
/// a positive radius, more than 2^24 balls, or a number as above), kOutOfMemory, kInterrupted; those of
/// measure_ball_union().
Result<Bounds> measure_gap(const IndexedMesh& mesh, std::span<const Ball> balls, const ProofOptions& options = {},
                           const std::stop_token& stop = {});

/// A lower bound of the depth of each point in the solid, in mesh units: its distance to the boundary if it is inside,
/// and minus that distance if it is outside, less a bound of the rounding. A ball around the point with that radius, if
/// it is positive, is proved to be inside, as by prove_spheres(). Sets one element of `depths` for each point. Errors:
/// kUsage (as many depths as points are required; a number as above), kOutOfMemory, kInterrupted.
Status measure_depths(const IndexedMesh& mesh, std::span<const Point> points, std::span<double> depths,
                      const ProofOptions& options = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
