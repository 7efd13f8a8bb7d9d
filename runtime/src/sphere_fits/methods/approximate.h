// Sphere sets of several sizes, to choose from at run time.
#pragma once

#include <vector>

#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// As approximate_by_spheres(), with sets of half, a quarter ... of its balls, the smallest first and the full one
/// last. Every set satisfies the contract by itself. With contract inside, each is a prefix of the last one; with other
/// contracts, method best computes each for its number of balls, and method source grows each from such a prefix.
Result<std::vector<SphereSet>> approximate_in_levels(const Solid& solid, const SphereFitOptions& options,
                                                     const Extractor& extractor, const SphereProgress& progress = {});

/// approximate_by_spheres() as a list of one set.
Result<std::vector<SphereSet>> approximate_once(const Solid& solid, const SphereFitOptions& options,
                                                const Extractor& extractor, const SphereProgress& progress = {});

}  // namespace medial_vk
