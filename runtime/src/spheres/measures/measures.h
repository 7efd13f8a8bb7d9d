// How good a set of balls is as a stand-in for a solid: volume, distances, and the numbers that others report.
#pragma once

#include <vector>

#include "spheres/measures/envelope_distance.h"
#include "spheres/measures/sphere_certificate.h"

namespace medial_vk {

/// Volumes in cubed mesh units.
struct VolumeError {
  double solid = 0;           ///< Of the solid.
  double balls = 0;           ///< Of their union: exact.
  double uncovered = 0;       ///< Of the solid outside the balls.
  double outside = 0;         ///< Of the balls outside the solid.
  double standard_error = 0;  ///< Of `uncovered` and `outside`, which then are estimates from samples; 0: exact.

  /// Err of Section 7.3.1 over the volume of the solid.
  double normalized() const { return solid > 0 ? (uncovered + outside) / solid : 0; }
  double normalized_standard_error() const { return solid > 0 ? 2 * standard_error / solid : 0; }
  /// What Err cannot be below (Lemma 7.1), over the volume of the solid.
  double normalized_lower_bound() const;
};

/// Under the names, and by the definitions, of cuRobo's SphereFitMetrics, but for what is said here. Lengths in mesh
/// units.
struct SphereFitMetrics {
  std::size_t num_spheres = 0;
  double coverage = 0;              ///< Share of the solid's volume that is in a ball (exact where VolumeError is).
  double protrusion = 0;            ///< Share of points of all spheres, as many on each, that are outside the solid.
  double protrusion_dist_mean = 0;  ///< Distance of those to the boundary; 0 without any.
  double protrusion_dist_p95 = 0;
  double surface_gap_mean = 0;  ///< Distance of points of the boundary to the balls, 0 in them.
  double surface_gap_p95 = 0;
  double max_uncovered_gap = 0;  ///< The greatest of these: not of samples, but the proved upper bound.
  double volume_ratio = 0;  ///< Sum of the volumes of all balls, overlaps counted as often, over that of the solid.
};

/// Distances with a sign over an area, in bins of equal width. Positive: the envelope is outside the solid.
struct SignedDistances {
  double lower = 0, upper = 0;  ///< Of the bins.
  std::vector<double> share;    ///< Of the area, by bin.
  double least = 0, greatest = 0, mean = 0, mean_absolute = 0;
};

/// Figure 8-2; both have the same bins.
struct DistanceHistograms {
  SignedDistances boundary_to_envelope;  ///< By area of the boundary.
  SignedDistances envelope_to_boundary;  ///< By area of the envelope.
};

struct SphereMeasures {
  double diagonal = 0;  ///< Of the solid's box, mesh units.
  InsideProof inside;
  CoverProof cover;
  VolumeError volume;
  EnvelopeDistances distances;
  SphereFitMetrics metrics;
  DistanceHistograms histograms;
};

struct MeasureOptions {
  double tolerance = 2e-4;       ///< Of the bounds of distances, as a share of the diagonal.
  std::uint64_t seed = 1;        ///< Of the samples that an inexact volume error is estimated from.
  std::size_t samples = 20'000;  ///< Of the boundary, and about as many of the envelope.
  Threads threads = {};
};

/// At least one ball. Exact are: the union's volume; the solid's, if Solid::has_volume(); the volume error of balls
/// that are proved to lie inside such a solid or to cover it. Other volumes are estimates from two samples in each cell
/// of a grid, with their standard error. Does not throw. Errors: those of measure_ball_union(), kOutOfMemory,
/// kInterrupted (`threads` does not go on).
Result<SphereMeasures> measure_spheres(const Solid& solid, std::span<const Ball> balls,
                                       const MeasureOptions& options = {});

/// measure_spheres().volume alone, of balls that are neither all inside nor a cover. Throws Stopped. Errors: those of
/// measure_ball_union().
Result<VolumeError> estimate_volume_error(const Solid& solid, std::span<const Ball> balls,
                                          const MeasureOptions& options = {});

/// The volume of a shape that facets stand for, from within (of balls proved to lie inside these) or from without (of
/// balls proved to cover them), takes the place of the facets' own: the error is then exactly that of the shape. Other
/// balls keep the facets for their measure; returns whether anything changed.
bool measure_against(double shape_volume, SphereMeasures& measures);

}  // namespace medial_vk
