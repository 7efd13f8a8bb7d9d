// A solid approximated by a given number of balls, capsules, cone-spheres or slabs, proved to lie inside
// (docs/theory.md, "Hulls of balls"; S. Stolpner, "Medial Spheres for Shape Representation", 2011, Section 8.7.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "medial_vk/extraction.h"
#include "medial_vk/hull_proofs.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

class Context;

/// The kinds of hulls of which a set is made.
enum class HullChoice : std::uint8_t {
  kBalls,
  kCapsules,  ///< Two balls of equal radius each.
  kCones,     ///< Two balls each.
  kSlabs,     ///< Three balls each.
  kMix,       ///< The best of the sets of one kind, at equal goals.
};

/// All given goals must be met, with as few hulls as the method finds.
struct HullFitOptions {
  HullChoice choice = HullChoice::kSlabs;
  std::size_t count = 0;       ///< Greatest number of hulls, at most kMostHulls; 0: as the other goals require.
  std::size_t parameters = 0;  ///< Greatest sum of parameters_of() their kinds; 0: no such goal.
  double error = 0;            ///< Greatest uncovered share of the solid's volume, in [0, 1); 0: no such goal.
  double max_gap = 0;          ///< Greatest distance from the boundary to the hulls, mesh units; 0: no such goal.
  /// The greatest difference of the bounds HullFit::covered, as a share of the solid's volume, or of the largest hull's
  /// where that is not known; 0: a fiftieth of the share that is left uncovered, within [1e-5, 1e-3].
  double width = 0;
  std::uint32_t resolution = 0;  ///< Of the extraction of medial points, as in ExtractionOptions; 0: derived.
  unsigned threads = 0;          ///< Of the host, 0: one per core. The result does not depend on it.

  bool operator==(const HullFitOptions&) const = default;
};

/// The greatest number of hulls.
constexpr std::size_t kMostHulls = 4096;

/// The result of fit_hulls(), in mesh units.
struct HullFit {
  /// Ordered such that every prefix is a good set of its size.
  std::vector<BallHull> hulls;
  HullProof proof;
  Bounds covered;  ///< The volume of the union.
  /// Suprema of the distance from points of the boundary to the hulls.
  Bounds gap;
  /// The greatest amount by which the proof made radii smaller than the search had left them.
  double greatest_shrink = 0;
  std::size_t left_out = 0;            ///< Hulls of the search without a proof, beside openings of the boundary.
  std::optional<double> solid_volume;  ///< If the mesh encloses one cleanly.
};

/// Fits hulls of balls into the solid that the mesh encloses, from medial points that `extractor` finds, proves that
/// they lie inside, and measures them. `progress` is called with "medial points", "hulls" and "measures", one call at a
/// time but from any thread. Does not throw. Errors: those of the extractor; kUsage (no goal, a goal out of range or
/// not reached); kInvalidMesh (no hull fits); kOutOfMemory; kInterrupted; kInternal if a proof fails (a defect).
Result<HullFit> fit_hulls(const IndexedMesh& mesh, const HullFitOptions& options, const Extractor& extractor,
                          const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<HullFit> fit_hulls(const IndexedMesh& mesh, const HullFitOptions& options, Context& context,
                          const StageProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
