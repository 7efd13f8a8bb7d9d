// The quality of a set of balls as an approximation of a solid: volume, distances, and metrics of other programs.
#pragma once

#include <cstdint>
#include <span>

#include "medial_vk/sphere_measures.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/quality/sphere_certificate.h"

namespace medial_vk {

struct MeasureOptions {
  double tolerance = 2e-4;       ///< Of the bounds of distances, as a share of the diagonal.
  std::uint64_t seed = 1;        ///< Of the samples for the estimate of an inexact volume error.
  std::size_t samples = 20'000;  ///< Of the boundary, and about as many of the envelope.
  Threads threads = {};
};

/// Precondition: at least one ball. The volume of the union is exact; so is that of the solid, if Solid::has_volume(),
/// and the volume error of balls that are proved to lie inside such a solid or to cover it. Other volumes are estimates
/// from two samples in each cell of a grid, with their standard error. Does not throw. Errors: those of
/// measure_ball_union(), kOutOfMemory, kInterrupted (a stop by `threads`).
Result<SphereMeasures> measure_spheres(const Solid& solid, std::span<const Ball> balls,
                                       const MeasureOptions& options = {});

/// measure_spheres().volume alone, of balls that are neither all inside nor a cover. Throws Stopped. Errors: those of
/// measure_ball_union().
Result<VolumeError> estimate_volume_error(const Solid& solid, std::span<const Ball> balls,
                                          const MeasureOptions& options = {});

}  // namespace medial_vk
