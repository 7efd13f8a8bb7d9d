// How far a solid and a union of balls are apart, in every sense that is in use, each between proved bounds.
#pragma once

#include "mesh/solid.h"
#include "spheres/measures/branch_and_bound.h"
#include "spheres/measures/envelope.h"

namespace medial_vk {

/// Suprema of distances, mesh units. The boundary is that of the mesh; the envelope is that of the balls.
struct EnvelopeDistances {
  Bounds solid_to_balls;        ///< From points of the solid to the balls: 0 if they cover it.
  Bounds balls_to_solid;        ///< From points of the balls to the solid: 0 if they lie inside.
  Bounds boundary_to_balls;     ///< From points of the boundary to the balls, 0 in them: the greatest gap.
  Bounds boundary_to_envelope;  ///< From points of the boundary to the envelope, from either side.
  Bounds envelope_to_boundary;  ///< From points of the envelope to the boundary, from either side.

  /// Two-sided, of solid and balls as sets.
  Bounds between_sets() const;
  /// Two-sided, of boundary and envelope.
  Bounds between_surfaces() const;
};

struct DistanceOptions {
  double tolerance = 1e-3;        ///< Of the diagonal of the solid's box: how far apart the bounds may be.
  std::size_t cells = 2'000'000;  ///< For each supremum; if that is not enough the bounds stay farther apart.
  Threads threads = {};
  bool known_inside = false;  ///< Certified: the balls lie inside the solid.
  bool known_cover = false;   ///< Certified: the balls cover the solid.
};

/// By branch and bound on functions that change no faster than the point moves (docs/theory.md, "Tight spheres"). Where
/// the mesh is open, the surface that closes the solid is no part of the boundary: solid_to_balls then cannot leave out
/// cells outside, so its bounds may stay far apart, and balls_to_solid takes a cell's side from its middle. Does not
/// throw. Errors: kUsage (no balls), kOutOfMemory, kInterrupted (`threads` does not go on).
Result<EnvelopeDistances> measure_distances(const Solid& solid, const Envelope& envelope,
                                            const DistanceOptions& options = {});

/// EnvelopeDistances::boundary_to_balls alone. Errors: also those of measure_ball_union().
Result<Bounds> measure_greatest_gap(const Solid& solid, std::span<const Ball> balls,
                                    const DistanceOptions& options = {});

}  // namespace medial_vk
