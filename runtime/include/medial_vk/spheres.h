// A solid as a given number of balls, which keep a contract that is proved (docs/theory.md, "Tight spheres").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// What the balls are promised to do (docs/theory.md, "Tight spheres").
enum class SphereContract {
  kInside,    ///< No point of a ball lies outside the solid.
  kCover,     ///< No point of the solid lies outside the balls.
  kBalanced,  ///< None; as little volume as possible between balls and solid, on both sides of the boundary.
};

enum class SphereMethod {
  kBest,    ///< Chosen and moved for the contract.
  kSource,  ///< One ball per voxel, the largest voxels that give no more balls than wanted (Section 7.3.2).
};

/// Goals that are given together must all be met, with as few balls as the method finds.
struct SphereOptions {
  SphereMethod method = SphereMethod::kBest;
  SphereContract contract = SphereContract::kInside;
  std::size_t count = 0;  ///< At most so many; 0: as many as the other goals take, which must be given then.
  /// Share of the solid's volume that is uncovered; kCover: that is added; kBalanced: both, by an estimate. 0: no such
  /// goal.
  double error = 0;
  double max_gap = 0;            ///< Greatest distance from the boundary to the balls, mesh units; 0: no such goal.
  std::uint32_t resolution = 0;  ///< Of the medial points to choose from, as ExtractionOptions; 0: by the count.
  double object_angle = 0.6;     ///< Of the method source.
  bool levels = false;           ///< Also sets of half, a quarter ... of the balls.
  unsigned threads = 0;          ///< Of the host, 0: one per core. The result does not depend on it.

  bool operator==(const SphereOptions&) const = default;
};

/// The limit where no count is given.
constexpr std::size_t kMostBalls = 20000;

/// What fit_spheres() finds, in mesh units.
struct SphereFit {
  /// Sets of balls, the smallest first; one, unless levels were requested. Every set keeps the contract by itself. The
  /// last one is ordered such that every prefix of balls inside is a good set of its own size.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;         ///< Per level: an upper bound of how far balls reach out of the solid.
  SphereMeasures measures;             ///< Of the last level.
  std::optional<double> solid_volume;  ///< If the mesh encloses one cleanly.
};

/// Fits balls to the solid that the mesh encloses, from medial spheres that `extractor` finds, proves that they keep
/// the contract, and measures them. `progress` is called with "medial points", "spheres" and "cover", one call at a
/// time but from any thread; `stop` ends the call soon. Does not throw. Errors: those of the extractor; kUsage (no
/// goal, a goal that the contract or method does not know, a goal that is not reached); kInvalidMesh (no ball fits);
/// kOutOfMemory; kInterrupted; kInternal if balls do not keep the contract (a defect).
Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereOptions& options, const Extractor& extractor,
                              const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereOptions& options, Context& context,
                              const StageProgress& progress = {}, const std::stop_token& stop = {});

/// How much of a solid is covered by 1, 2, 3 ... balls inside it: what is needed to distribute balls among solids.
struct CoverageCurve {
  std::vector<double> covered;         ///< Volume of the union of the balls when there were 1, 2, 3 ... of them.
  bool ends = false;                   ///< No more balls are to be had than these.
  std::optional<double> solid_volume;  ///< If the mesh encloses one cleanly.
};

/// For at least `options.count` balls, or as many as there are. Contract and goals of the options are not read. Errors:
/// those of fit_spheres().
Result<CoverageCurve> measure_coverage_curve(const IndexedMesh& mesh, const SphereOptions& options,
                                             const Extractor& extractor, const StageProgress& progress = {},
                                             const std::stop_token& stop = {});

}  // namespace medial_vk
