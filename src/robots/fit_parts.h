// Spheres for all parts of a robot.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/spheres.h"
#include "robots/parts.h"

namespace medial_vk {

struct FitGoals {
  SphereOptions options;           ///< For each part; its count is set from the next two if they are given.
  std::size_t count_per_link = 0;  ///< Distributed among the parts of each link; 0: not given.
  std::size_t total = 0;           ///< Distributed among all parts; 0: not given.
};

/// The spheres of one part.
struct PartFit {
  /// In the frame of the link, the smallest first; one unless levels were requested. All parts have as many levels:
  /// where one has no smaller set, its smallest stands there again.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;           ///< Per level: an upper bound of how far balls reach out of the part.
  std::size_t wanted = 0;                ///< Balls that it was given; 0: as many as its other goals took.
  std::optional<double> solid_volume;    ///< Of its mesh, if that encloses one cleanly; else see `of_shape`.
  bool of_shape = false;                 ///< The volume and its errors are those of a primitive, not of its facets.
  std::optional<double> spheres_volume;  ///< Of the union of the last level.
  /// Of the last level, too; in the frame of the part, where its contract is proved. Not of parts that are balls.
  std::optional<SphereMeasures> measures;
  std::vector<Ball>
      proved;  ///< The last level in the frame of the part, as it was proved. Not of parts that are balls.
  double seconds = 0;
};

/// Called with the part that is fitted and the share done of all, one call at a time, from any thread.
using FitProgress = std::function<void(const Part& part, double done)>;

/// Contract inside: no ball is outside its part, even by the rounding of its pose. A goal for several parts is
/// distributed by need (robots/share_out.h): error against count is that of balls inside, whatever the contract. With
/// the method best a larger number gives no part fewer balls, and no part of contract inside more error. Every part is
/// indexed once. Errors: those of fit_spheres(), naming link and part; kUsage if a link has more parts than balls.
Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const FitGoals& goals, const Extractor& extractor,
                                       const FitProgress& progress = {}, const std::stop_token& stop = {});

/// The fit of a mesh by itself, whose frame is its own. `wanted`: balls that were requested; 0: none.
PartFit as_part_fit(SphereFit fit, std::size_t wanted);

}  // namespace medial_vk
