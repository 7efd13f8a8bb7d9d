// How good a set of balls is as a stand-in for a solid: proofs, volume, distances, and the numbers that others report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// What is known of a number.
struct Bounds {
  double lower = 0, upper = 0;
};

/// Every centre is inside and every radius at most the exact distance from there to the boundary.
struct InsideProof {
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  std::uint32_t first_failure = 0;  ///< Index of a ball, if any failed.
  double worst = 0;  ///< The greatest radius less distance, mesh units, rounding on the side of failure; 0: no ball.

  bool proved() const { return failed == 0; }
};

/// Every triangle is cut into pieces that lie in one ball each, and no vertex of the envelope lies in the solid.
struct CoverProof {
  std::uint64_t triangles = 0;  ///< Of the boundary.
  std::uint64_t uncovered = 0;  ///< Of these: with a point that is in no ball.
  std::uint64_t undecided = 0;  ///< Of these: neither that nor covered by pieces of a reasonable number and size.
  Point first_uncovered{};      ///< Of the first triangle that is uncovered or undecided: a point where it shows.
  std::uint64_t vertices = 0;   ///< Of the envelope.
  std::uint64_t inside = 0;     ///< Of these: in the solid, or too near its boundary to tell: cavities.
  Point first_inside{};         ///< The first of them.
  bool closed = true;           ///< Else only the surface is proved to be covered.

  bool surface_proved() const { return uncovered == 0 && undecided == 0; }
  bool proved() const { return closed && surface_proved() && inside == 0; }
};

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

/// The volume of a shape that facets stand for, from within (of balls proved to lie inside these) or from without (of
/// balls proved to cover them), takes the place of the facets' own: the error is then exactly that of the shape. Other
/// balls keep the facets for their measure; returns whether anything changed.
bool measure_against(double shape_volume, SphereMeasures& measures);

/// How far balls reach out of their solid at most, over the balls of a set; all 0 where none does.
struct ReachOut {
  double mean = 0, best = 0, worst = 0;
};

}  // namespace medial_vk
