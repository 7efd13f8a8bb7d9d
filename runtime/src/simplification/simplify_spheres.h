// Removal of medial points that lie close together at the faces between voxels (end of Section 2.4.2).
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Removes medial points within `epsilon` (a length) of one that is kept, and returns the number removed.
///
/// Section 2.4.2: the boundary point M nearest to a medial point m may also lie on balls whose centres are within
/// epsilon of m along grad D(m). Without these, every remaining ball is maximal in the union of the balls. Points
/// within epsilon of each other are in voxels that touch, since epsilon is at most half a voxel side. A greedy pass in
/// voxel order therefore compares each point with the kept points in the 26 voxels around, and keeps it if none is
/// within epsilon. The result is deterministic, a second pass removes nothing, and every kept point stands for at most
/// 7 removed ones.
///
/// Precondition: spheres in voxel order, at most one per voxel, as an extraction returns them; epsilon <= voxel side.
std::uint64_t simplify_spheres(double epsilon, std::vector<MedialSphere>& spheres);

}  // namespace medial_vk
