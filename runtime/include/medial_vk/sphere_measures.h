// The quality of a set of balls as an approximation of a solid: proofs, volume, distances, and metrics of other
// programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Proved bounds of a number.
struct Bounds {
  double lower = 0, upper = 0;
};

/// The proof that every centre is inside, and every radius at most the exact distance from the centre to the boundary.
struct InsideProof {
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  std::uint32_t first_failure = 0;  ///< Index of a ball, if any failed.
  /// The greatest excess of a radius over the distance, in mesh units, rounded up (towards failure); 0: no ball.
  double greatest_excess = 0;

  bool proved() const { return failed == 0; }
};

/// The proof that every triangle can be cut into parts that lie in one ball each, and that no vertex of the envelope
/// lies in the solid.
struct CoverProof {
  std::uint64_t triangles = 0;  ///< Of the boundary.
  std::uint64_t uncovered = 0;  ///< Of these: triangles with a point in no ball.
  /// Of these: triangles for which neither such a point nor a cover by a reasonable number of parts was found.
  std::uint64_t undecided = 0;
  Point first_uncovered{};     ///< A point where the first uncovered or undecided triangle failed.
  std::uint64_t vertices = 0;  ///< Of the envelope.
  std::uint64_t inside = 0;    ///< Of these: vertices in the solid, or too near its boundary to decide: cavities.
  Point first_inside{};        ///< The first of them.
  bool closed = true;          ///< False: only the boundary is proved to be covered.

  bool surface_proved() const { return uncovered == 0 && undecided == 0; }
  bool proved() const { return closed && surface_proved() && inside == 0; }
};

/// Suprema of distances, in mesh units. The boundary is that of the solid, the envelope that of the union of the balls.
struct EnvelopeDistances {
  Bounds solid_to_balls;        ///< From points of the solid to the balls: 0 if they cover it.
  Bounds balls_to_solid;        ///< From points of the balls to the solid: 0 if they lie inside.
  Bounds boundary_to_balls;     ///< From points of the boundary to the balls, 0 in them: the greatest gap.
  Bounds boundary_to_envelope;  ///< From points of the boundary to the envelope, from either side.
  Bounds envelope_to_boundary;  ///< From points of the envelope to the boundary, from either side.

  /// Two-sided distance of solid and balls as sets.
  Bounds between_sets() const;
  /// Two-sided distance of boundary and envelope.
  Bounds between_surfaces() const;
};

/// Volumes in cubed mesh units.
struct VolumeError {
  double solid = 0;           ///< Of the solid.
  double balls = 0;           ///< Of their union: exact.
  double uncovered = 0;       ///< Of the solid outside the balls.
  double outside = 0;         ///< Of the balls outside the solid.
  double standard_error = 0;  ///< Of `uncovered` and `outside`, if they are estimates from samples; 0: they are exact.

  /// Err of Section 7.3.1 over the volume of the solid.
  double normalized() const { return solid > 0 ? (uncovered + outside) / solid : 0; }
  double normalized_standard_error() const { return solid > 0 ? 2 * standard_error / solid : 0; }
  /// The lower bound of Err (Lemma 7.1), over the volume of the solid.
  double normalized_lower_bound() const;
};

/// Names and definitions are those of cuRobo's SphereFitMetrics, except where a comment states a difference. Lengths
/// are in mesh units.
struct SphereFitMetrics {
  std::size_t num_spheres = 0;
  double coverage = 0;    ///< Share of the solid's volume that is in a ball (exact where VolumeError is).
  double protrusion = 0;  ///< Share of sampled points of the spheres, equally many on each, that are outside the solid.
  double protrusion_dist_mean = 0;  ///< Mean distance of those points to the boundary; 0 if there are none.
  double protrusion_dist_p95 = 0;
  double surface_gap_mean = 0;  ///< Mean distance of points of the boundary to the balls, 0 in them.
  double surface_gap_p95 = 0;
  double max_uncovered_gap = 0;  ///< The proved upper bound of these distances, instead of the greatest of samples.
  /// Sum of the volumes of all balls, overlaps counted repeatedly, over the volume of the solid.
  double volume_ratio = 0;
};

/// A histogram of signed distances by area, in bins of equal width. Positive: the envelope is outside the solid.
struct SignedDistances {
  double lower = 0, upper = 0;  ///< Of the bins.
  std::vector<double> share;    ///< Of the area, by bin.
  double least = 0, greatest = 0, mean = 0, mean_absolute = 0;
};

/// The histograms of Figure 8-2; both have the same bins.
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

/// Refers the measures to a curved shape that the mesh approximates: replaces the volume of the solid by
/// `shape_volume`, in cubed mesh units, and recomputes the volume error, the coverage and the volume ratio. The result
/// is exact if the mesh encloses the shape (balls with the proof `cover`), or lies inside it (balls with the proof
/// `inside`). Without either proof nothing is changed, and the function returns false.
bool measure_against(double shape_volume, SphereMeasures& measures);

/// Upper bounds of the distances by which the balls of a set reach out of the solid: their mean, least and greatest.
/// All are 0 if no ball reaches out.
struct ReachOut {
  double mean = 0, least = 0, greatest = 0;
};

}  // namespace medial_vk
