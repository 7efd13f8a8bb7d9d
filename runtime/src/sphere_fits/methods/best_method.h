// The method best: tight balls for a solid, chosen and moved for the contract.
#pragma once

#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Adds balls inside the solid one after the other. The next ball is the medial ball that adds the most volume,
/// measured exactly; or the ball in the widest gap between union and boundary, which is chosen for every eighth ball,
/// and for any other if it adds at least 0.4 of that volume. Then the ball and its neighbours slide in the direction of
/// the greatest growth of the union, while their contacts move along the boundary (docs/theory.md, "Tight spheres").
/// Neither the choice of a ball nor its motion depends on the requested number, and no step reduces the union, so more
/// balls never leave more volume uncovered. With the contract balanced, balls also grow and move beyond the boundary to
/// minimise SymmetricDifference, which more balls never increase. Errors: those of approximate_by_spheres().
Result<SphereSet> best_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                               const SphereProgress& progress);

}  // namespace medial_vk
