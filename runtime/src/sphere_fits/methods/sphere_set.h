// Sets of balls, the results of the methods.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/sphere_fits.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

struct SphereSet {
  /// In mesh units. Of balls inside, every prefix is a good set of its own size: the levels (SphereFitOptions::levels).
  std::vector<Ball> balls;
  /// Method best, contract inside: volume of the union after 1, 2, 3 ... balls, which is the same for every requested
  /// number. (Not that of the first balls here, as balls move while others are added.)
  std::vector<double> volumes = {};
  /// Likewise, the balls after 1, 4, 16, 64, 96, 128, 192 ... of them, by that number, and the final ones; method best,
  /// balanced: the balls at the numbers of the levels.
  std::map<std::size_t, std::vector<Ball>> stages = {};
};

/// Certified balls of the medial points inside the solid. Errors: those of extract_and_certify().
Result<std::vector<Ball>> find_medial_balls(const Solid& solid, const ExtractionOptions& options,
                                            const Extractor& extractor, const SphereProgress& progress);

/// Approximates the solid. Does not throw. Errors: those of fit_spheres().
Result<SphereSet> approximate_by_spheres(const Solid& solid, const SphereFitOptions& options,
                                         const Extractor& extractor, const SphereProgress& progress = {});

}  // namespace medial_vk
