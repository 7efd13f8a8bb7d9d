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
  SphereOptions options;           ///< For each part; the next two, if given, determine its count.
  std::size_t count_per_link = 0;  ///< Distributed among the parts of each link; 0: not given.
  std::size_t total = 0;           ///< Distributed among all parts; 0: not given.
};

/// The spheres of one part.
struct PartFit {
  /// In the frame of the link, the smallest first; one unless levels were requested. All parts have the same number of
  /// levels: a part without a smaller set repeats its smallest.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;  ///< Per level: an upper bound of the distance by which balls reach out of the part.
  std::size_t wanted = 0;       ///< The number of balls assigned to it; 0: as many as its other goals took.
  std::optional<double> solid_volume;    ///< Of its mesh, if that encloses one cleanly; else see `of_shape`.
  bool of_shape = false;                 ///< The volume and its errors are those of a primitive, not of its facets.
  std::optional<double> spheres_volume;  ///< Of the union of the last level.
  /// Of the last level, too, in the frame of the part, where its contract is proved. Absent for parts that are balls.
  std::optional<SphereMeasures> measures;
  std::vector<Ball>
      proved;  ///< The last level in the frame of the part, as it was proved. Not of parts that are balls.
  double seconds = 0;
};

/// Receives the current part and the completed share of all parts, one call at a time, from any thread.
using FitProgress = std::function<void(const Part& part, double done)>;

/// Contract inside: no ball is outside its part, even by the rounding of its pose. A goal for several parts is
/// distributed by need (robots/share_out.h), measured by error against count of balls inside, for every contract. With
/// the method best a larger number gives no part fewer balls, and no part of contract inside more error. Every part is
/// indexed once, and `extractor` runs once for each resolution of it. Errors: those of fit_spheres(), naming link and
/// part; kUsage if a link has more parts than balls.
Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const FitGoals& goals, const Extractor& extractor,
                                       const FitProgress& progress = {}, const std::stop_token& stop = {});

/// The fit of a single mesh in its own frame. `wanted`: the number of balls requested; 0: none.
PartFit as_part_fit(SphereFit fit, std::size_t wanted);

}  // namespace medial_vk
