// The source's own sphere sets, kept for comparison: one medial ball per voxel, with the voxel side as the only
// parameter (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Sections 7.2 and 7.3.2).
#pragma once

#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Medial balls of certified mode, inside the solid, ordered so that prefixes are good sets. With `request.count` or
/// `request.error` the voxels along the longest side are found by doubling and bisection: the finest grid tried that
/// gives no more balls than requested, or the coarsest one tried with no more than the error; the number of balls does
/// not always rise with the resolution (Section 7.2), so another grid may be better. With neither, the grid is
/// `request.resolution`, which otherwise must be 0. Sides are whole fractions of the longest side, so a count may be
/// missed by a step. Errors: kUsage if even the coarsest grid has more balls than requested, if no grid reaches the
/// error, or for goals that this method does not support (max_gap); those of extract_and_certify(); kInterrupted.
Result<SphereSet> source_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                                 const SphereProgress& progress);

}  // namespace medial_vk
