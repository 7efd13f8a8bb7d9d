// A solid approximated by a given number of balls, with a proved contract (docs/theory.md, "Tight spheres").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

class Context;

/// The proved property of the balls (docs/theory.md, "Tight spheres").
enum class SphereContract {
  kInside,    ///< No point of a ball lies outside the solid.
  kCover,     ///< No point of the mesh or the solid lies outside the balls (see PrepareOptions::keep_outer_faces).
  kBalanced,  ///< None; the volume between balls and solid, on both sides of the boundary, is kept small.
};

enum class SphereMethod {
  kBest,    ///< Chosen and moved for the contract.
  kSource,  ///< One ball per voxel, for the smallest voxels that give no more balls than requested (Section 7.3.2).
};

/// What a set of balls is chosen by (docs/theory.md, "Thin parts").
enum class SphereAim {
  kVolume,    ///< Inside: little of the volume is uncovered; other contracts: as they say.
  kDistance,  ///< Inside: no point of the boundary is far from all balls, whatever is uncovered. As in a thin plate.
  /// kDistance where so many balls as large as the largest in the solid have no more than half of its volume together,
  /// and else kVolume, as on meshes that enclose no volume cleanly.
  kAuto,
};

/// All given goals must be met, with as few balls as the method finds.
struct SphereFitOptions {
  SphereMethod method = SphereMethod::kBest;
  SphereContract contract = SphereContract::kInside;
  /// Greatest number of balls; 0: the number that the other goals require, of which one must then be given, or, with
  /// method kSource, the resolution.
  std::size_t count = 0;
  /// Greatest volume error, as a share of the solid's volume: kInside: the uncovered volume; kCover: the added volume;
  /// kBalanced: the sum of both, by an estimate. In [0, 1); 0: no such goal.
  double error = 0;
  double max_gap = 0;  ///< Greatest distance from the boundary to the balls, mesh units; 0: no such goal.
  /// kBalanced: the greatest Hausdorff distance of the boundary and the surface of the balls, mesh units; 0: no such
  /// bound. With `count` alone, a bound for so many balls (kUsage if they cannot keep it), else a goal. By the method
  /// best; at least 1e-3 of the diagonal of the solid's box.
  double max_distance = 0;
  /// kCover: greatest distance by which balls reach out, mesh units (ReachOut::greatest); 0: no such goal. With `count`
  /// as a limit, or alone: without `error`, `levels` and `for_distances`, by the method best.
  double max_reach = 0;
  /// Other aims than kVolume: contract kInside by the method best, by `count` or `max_gap`, without `error` and
  /// `for_distances`.
  SphereAim aim = SphereAim::kVolume;
  /// The resolution of the extraction of candidate points, as in ExtractionOptions; 0: derived from the count.
  std::uint32_t resolution = 0;
  double object_angle = 0.6;  ///< Of method source.
  bool levels = false;        ///< Also return sets of half, a quarter ... of the balls.
  /// Only balls and the proof of their contract, for a fraction of the time: SphereFit::measures has nothing but that
  /// proof, and a cover by `count` is searched for that number alone, so that it may have more volume than one of a
  /// smaller `count`. Without `levels`.
  bool balls_only = false;
  /// For distances to other solids: the balls are chosen such that these become bounds of little difference, instead of
  /// for a small volume error, which is greater then. Method kBest, contract kInside or kCover, `count` alone, without
  /// `levels`.
  bool for_distances = false;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.

  bool operator==(const SphereFitOptions&) const = default;
};

/// The greatest number of balls if no count is given.
constexpr std::size_t kMostBalls = 20000;

/// The result of fit_spheres(), in mesh units.
struct SphereFit {
  /// Sets of balls, the smallest first; one, unless levels were requested. Every set satisfies the contract by itself.
  /// With contract kInside, the last set is ordered such that every prefix is a good set of its size.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;         ///< Per level: upper bounds of the distances by which balls reach out.
  SphereMeasures measures;             ///< Of the last level; with SphereFitOptions::balls_only its proof alone.
  std::optional<double> solid_volume;  ///< If the mesh encloses one cleanly.
  /// By what the balls were chosen: that of the options, and for kAuto the one that it stands for.
  SphereAim aim = SphereAim::kVolume;
};

/// Fits balls to the solid that the mesh encloses, from medial spheres that `extractor` finds, proves the contract, and
/// measures the balls. `progress` is called with "medial points", "spheres" and "cover", one call at a time but from
/// any thread, and with the finished share of the stage; for a cover by `count` it is that of all stages, and never
/// falls. A request to `stop` soon ends the call. Does not throw. Errors: those of the extractor; kUsage (no goal, a
/// goal out of range, a goal that the contract, the method or the mesh does not support, a goal that is not reached);
/// kInvalidMesh (no ball fits); kOutOfMemory; kInterrupted; kInternal if balls violate the contract (a defect).
Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereFitOptions& options, const Extractor& extractor,
                              const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereFitOptions& options, Context& context,
                              const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The volume of a solid that 1, 2, 3 ... balls inside it cover, by which balls are distributed among solids.
struct CoverageCurve {
  std::vector<double> covered;         ///< Volume of the union of the first 1, 2, 3 ... balls.
  bool ends = false;                   ///< True if the method finds no more balls than these.
  std::optional<double> solid_volume;  ///< If the mesh encloses one cleanly.
};

/// The curve for at least `options.count` balls, or for as many as the method finds. The contract and the goals of the
/// options are not read. Errors: those of fit_spheres().
Result<CoverageCurve> measure_coverage_curve(const IndexedMesh& mesh, const SphereFitOptions& options,
                                             const Extractor& extractor, const StageProgress& progress = {},
                                             const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<CoverageCurve> measure_coverage_curve(const IndexedMesh& mesh, const SphereFitOptions& options, Context& context,
                                             const StageProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
