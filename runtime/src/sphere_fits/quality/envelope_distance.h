// The distances between a solid and a union of balls, in all senses in use, each between proved bounds.
#pragma once

#include "medial_vk/sphere_measures.h"
#include "solid/solid.h"
#include "sphere_fits/quality/branch_and_bound.h"
#include "sphere_fits/quality/envelope.h"

namespace medial_vk {

struct EnvelopeOptions {
  double tolerance = 1e-3;        ///< Greatest difference of two bounds, as a share of the diagonal of the solid's box.
  std::size_t cells = 2'000'000;  ///< For each supremum; if they do not suffice, the bounds differ by more.
  Threads threads = {};
  bool known_inside = false;  ///< Certified: the balls lie inside the solid.
  bool known_cover = false;   ///< Certified: the balls cover the solid.
};

/// By branch and bound on functions with Lipschitz constant 1 (docs/theory.md, "Tight spheres"). Where the mesh is
/// open, the surface that closes the solid is no part of the boundary: solid_to_balls then cannot exclude cells
/// outside, so its bounds may stay far apart, and balls_to_solid decides a cell's side at its middle. Does not throw.
/// Errors: kUsage (no balls), kOutOfMemory, kInterrupted (a stop by `threads`).
Result<EnvelopeDistances> measure_distances(const Solid& solid, const Envelope& envelope,
                                            const EnvelopeOptions& options = {});

/// EnvelopeDistances::boundary_to_balls alone. Errors: also those of measure_ball_union().
Result<Bounds> measure_greatest_gap(const Solid& solid, std::span<const Ball> balls,
                                    const EnvelopeOptions& options = {});

/// EnvelopeDistances::between_surfaces() alone. Errors: as of measure_greatest_gap().
Result<Bounds> measure_surface_distance(const Solid& solid, std::span<const Ball> balls,
                                        const EnvelopeOptions& options = {});

}  // namespace medial_vk
