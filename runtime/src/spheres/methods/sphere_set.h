// A solid as a given number of balls.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "analysis/extract.h"
#include "medial_vk/queries.h"
#include "mesh/solid.h"

namespace medial_vk {

/// What the balls are promised to do (docs/theory.md, "Tight spheres").
enum class SphereContract {
  kInside,    ///< No point of a ball lies outside the solid.
  kCover,     ///< No point of the solid lies outside the balls.
  kBalanced,  ///< None; as little volume as possible between balls and solid, on both sides of the boundary.
};

enum class SphereMethod {
  kBest,    ///< Chosen and moved for what the contract asks for.
  kSource,  ///< One ball per voxel, the largest voxels that give no more balls than wanted (Section 7.3.2).
};

/// Goals that are given together must all be met, with as few balls as the method finds.
struct SphereRequest {
  SphereMethod method = SphereMethod::kBest;
  SphereContract contract = SphereContract::kInside;
  std::size_t count = 0;  ///< At most so many; 0: as many as the other goals take, which must be given then.
  /// Share of the solid's volume that is uncovered; kCover: that is added; kBalanced: both, by an estimate. 0: no such
  /// goal.
  double error = 0;
  double max_gap = 0;            ///< Greatest distance from the boundary to the balls, mesh units; 0: no such goal.
  std::uint32_t resolution = 0;  ///< Of the medial points to choose from, as ExtractionParameters; 0: by the count.
  double object_angle = 0.6;     ///< Of the method source.
  unsigned threads = 0;          ///< 0: all. The result does not depend on it.

  bool operator==(const SphereRequest&) const = default;
};

/// Where no count is given.
constexpr std::size_t kMostBalls = 20000;

struct SphereSet {
  /// In mesh units. Of balls inside, every prefix is a good set of its own size: the levels (`--levels`).
  std::vector<Ball> balls;
  /// Of the method best, balls inside: volume of the union when there were 1, 2, 3 ... balls, which is the same for
  /// every number wanted. (Not that of the first balls here: balls move while others come.)
  std::vector<double> volumes = {};
  /// Likewise, the balls when there were 1, 4, 16, 64, 128, 256 ... of them, by that number, and all that there are; of
  /// the method best, balanced: when there were as many as a level has.
  std::map<std::size_t, std::vector<Ball>> stages = {};
};

/// Stage and share of it done; return false to stop.
using SphereProgress = StageProgress;

/// Approximates the solid. `context` is needed by Backend::kVulkan only. Does not throw. Errors: those of
/// extract_and_certify(); kUsage (no goal; a goal that the contract does not know); kInterrupted.
Result<SphereSet> approximate_by_spheres(const Solid& solid, const SphereRequest& request, Backend backend,
                                         Context* context, const SphereProgress& progress = {});

}  // namespace medial_vk
