// Spheres for all parts of a robot, or for one mesh.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checks/check_report.h"
#include "robots/parts.h"
#include "spheres/measures/measures.h"
#include "spheres/measures/reach_out.h"
#include "spheres/methods/sphere_set.h"

namespace medial_vk {

struct FitGoals {
  SphereRequest request;           ///< For each part; its count is set from the next two if they are given.
  std::size_t count_per_link = 0;  ///< Shared out among the parts of each link; 0: not given.
  std::size_t total = 0;           ///< Shared out among all parts; 0: not given.
  bool levels = false;             ///< Also sets of half, a quarter ... of the balls.
  bool check = false;              ///< Also ask the CPU reference whether the contract is kept.
};

/// What one part came to.
struct PartFit {
  /// In the frame of the link, the smallest first; one unless levels were asked for. All parts have as many levels:
  /// where one has no smaller set, its smallest stands there again.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;           ///< Per level: an upper bound of how far balls reach out of the part.
  std::size_t wanted = 0;                ///< Balls that it was given; 0: as many as its other goals took.
  std::optional<double> solid_volume;    ///< Of its mesh, if that encloses one cleanly; else see `of_shape`.
  bool of_shape = false;                 ///< The volume and its errors are those of a primitive, not of its facets.
  std::optional<double> spheres_volume;  ///< Of the union of the last level.
  // Of the last level, too; in the frame of the part, where its contract is proved. Not of parts that are balls.
  std::optional<SphereMeasures> measures;
  std::optional<CheckReport> check;  ///< If it was asked for.
  double seconds = 0;
};

enum class FitStage {
  kSpheres,  ///< Found, proved and measured.
  kCheck,    ///< By the reference, which cannot be stopped half-way; nothing is lost by ending the process.
};

/// Called with the stage and the part that is worked at, and the share done of all; return false to stop. Calls come
/// one at a time, from any thread.
using FitProgress = std::function<bool(FitStage stage, const Part& part, double done)>;

/// `contract` inside: no ball is outside its part, even by the rounding of its pose. A goal that is shared out is so by
/// need (robots/share_out.h): error against count is that of balls inside, whatever the contract. With the method best
/// a larger number gives no part fewer balls, and no part of contract inside more error. Errors: those of
/// approximate_by_spheres() and measure_spheres(), naming link and part; kUsage if a link has more parts than balls;
/// kInternal if balls do not keep the contract, for which no reason is known.
Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const FitGoals& goals, Backend backend,
                                       Context* context, const FitProgress& progress = {});

}  // namespace medial_vk
