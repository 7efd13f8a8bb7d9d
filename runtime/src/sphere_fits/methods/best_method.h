// The method best: tight balls for a solid, chosen and moved for the contract.
#pragma once

#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Balls inside the solid, one after the other: each is the medial ball that adds most volume, exactly measured, or,
/// one in eight and where that adds nearly as much, lies where the union is farthest from the boundary; then it and its
/// neighbours slide in the direction of the greatest growth of the union, while their contacts move along the boundary
/// (docs/theory.md, "Tight spheres"). Neither the choice of a ball nor its motion depends on the requested number, and
/// no step reduces the union: more balls never leave more volume uncovered. With the contract balanced they also grow
/// and move beyond the boundary to minimise SymmetricDifference, and more balls never make that larger. Errors: those
/// of approximate_by_spheres().
Result<SphereSet> best_spheres(const Solid& solid, const SphereOptions& options, const Extractor& extractor,
                               const SphereProgress& progress);

}  // namespace medial_vk
