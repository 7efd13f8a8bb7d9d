// Sphere sets of several sizes, to choose from at run time.
#pragma once

#include <vector>

#include "spheres/methods/sphere_set.h"

namespace medial_vk {

/// As approximate_by_spheres(), and sets of half, a quarter ... of its balls, the smallest first and that one last.
/// Every set keeps the contract by itself: those inside the solid are beginnings of the last one; of the method best
/// the others are the answers for their numbers, of the method source they are grown from such a beginning.
Result<std::vector<SphereSet>> approximate_in_levels(const Solid& solid, const SphereOptions& request,
                                                     const Extractor& extractor, const SphereProgress& progress = {});

/// approximate_by_spheres() as a list of one set.
Result<std::vector<SphereSet>> approximate_once(const Solid& solid, const SphereOptions& options,
                                                const Extractor& extractor, const SphereProgress& progress = {});

}  // namespace medial_vk
