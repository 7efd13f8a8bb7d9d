// The tightest balls for a solid that we know how to find.
#pragma once

#include "spheres/methods/sphere_set.h"

namespace medial_vk {

/// Balls inside the solid, one after the other: each is the medial ball that adds most volume, exactly measured, or,
/// one in eight and where that adds nearly as much, lies where the union is farthest from the boundary; then it and its
/// neighbours slide to where the union grows most, their contacts with the boundary moving along (docs/theory.md,
/// "Tight spheres"). Neither how a ball is chosen nor how it moves depends on how many are wanted, and no step lets the
/// union shrink: more balls never leave more volume uncovered. With the contract balanced they also grow and move
/// beyond the boundary, to where SymmetricDifference is least, and more balls never make that larger. Errors: those of
/// approximate_by_spheres().
Result<SphereSet> best_spheres(const Solid& solid, const SphereOptions& request, const Extractor& extractor,
                               const SphereProgress& progress);

}  // namespace medial_vk
