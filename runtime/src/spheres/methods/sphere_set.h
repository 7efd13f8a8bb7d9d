// Sets of balls as the methods make them.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/spheres.h"
#include "mesh/solid.h"
#include "spheres/measures/threads.h"

namespace medial_vk {

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

/// Certified balls of the medial points of the solid. Errors: those of extract_and_certify().
Result<std::vector<Ball>> find_medial_balls(const Solid& solid, const ExtractionOptions& options,
                                            const Extractor& extractor, const SphereProgress& progress);

/// Approximates the solid. Does not throw. Errors: those of fit_spheres().
Result<SphereSet> approximate_by_spheres(const Solid& solid, const SphereOptions& options, const Extractor& extractor,
                                         const SphereProgress& progress = {});

}  // namespace medial_vk
