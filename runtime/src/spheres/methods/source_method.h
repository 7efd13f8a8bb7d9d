// The source's own sphere sets, kept for comparison: one medial ball per voxel, with the voxel side as the only handle
// (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Sections 7.2 and 7.3.2).
#pragma once

#include "spheres/methods/sphere_set.h"

namespace medial_vk {

/// Medial balls of certified mode, inside the solid, ordered so that beginnings are good sets. With `request.count` or
/// `request.error` the voxels along the longest side are found by doubling and bisection: the finest grid that was seen
/// to give no more balls than wanted, the coarsest that was seen to leave no more than the error; the number of balls
/// does not always rise with the resolution (Section 7.2), so another grid may do better. With neither, the grid is
/// `request.resolution`, which otherwise must be 0. Sides are whole fractions of the longest side, so a count may be
/// missed by a step. Errors: kUsage if even the coarsest grid has more balls than wanted, if no grid reaches the error,
/// or for goals that this method does not know (max_gap); those of extract_and_certify(); kInterrupted.
Result<SphereSet> source_spheres(const Solid& solid, const SphereOptions& request, const Extractor& extractor,
                                 const SphereProgress& progress);

}  // namespace medial_vk
