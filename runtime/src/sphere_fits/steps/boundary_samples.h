// Points of the boundary of a solid, with directions into it.
#pragma once

#include <cstddef>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

struct BoundarySample {
  Point at;
  Point inward;  ///< A unit normal into the solid; at a corner, the mean normal; zero where there is none.
};

/// Corners, up to `count` of them, and as many points inside triangles in proportion to their area: a lattice (R_2 of
/// M. Roberts) that is folded into each triangle.
std::vector<BoundarySample> sample_boundary(const Mesh& mesh, std::size_t count);

}  // namespace medial_vk
