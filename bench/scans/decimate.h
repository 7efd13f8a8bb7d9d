// Fewer triangles where the surface is flat, as a scanner's software makes them.
#pragma once

#include <cstddef>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// Collapses edges of a closed manifold, the one with the least error first, until at most `triangles` are left or
/// none can be collapsed: the error of a vertex is the sum of the squared distances to the planes of the triangles that
/// it replaces, weighted by their areas (Garland and Heckbert 1997). The result is a closed manifold.
Mesh decimate(const Mesh& mesh, std::size_t triangles);

}  // namespace medial_vk::bench
