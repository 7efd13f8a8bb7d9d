// Thinning of medial points that crowd at the walls between voxels (end of Section 2.4.2).
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Removes medial points within `epsilon` (a length) of one that is kept, and returns the number removed.
///
/// Section 2.4.2: the boundary point M nearest to a medial point m may also lie on the balls whose centres are within
/// epsilon of m along grad D(m); without those, every ball left is maximal in the union of the balls. Points so close
/// sit in voxels that touch, as epsilon is at most half a voxel: the search is greedy, in voxel order, among the 26
/// neighbours. A pass keeps the first point of each crowd and removes at most 7 for each one kept, so the result is
/// deterministic, a second pass removes nothing, and every removed point has a kept one within epsilon.
///
/// Precondition: spheres in voxel order, at most one per voxel, as extraction gives them; epsilon <= voxel side.
std::uint64_t simplify_spheres(double epsilon, std::vector<MedialSphere>& spheres);

}  // namespace medial_vk
