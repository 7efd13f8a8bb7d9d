#pragma once

#include <vector>

#include "site_voronoi/tile_search.h"

namespace medial_vk {

/// Fills points, faces and pieces from the points of all voxels and the edges of the grid, both in any order; the grid
/// of `voronoi` is set. Of points at one place, on the common face of voxels, the first is kept. Throws std::bad_alloc,
/// LoopStopped.
void make_surface(std::vector<SitePoint> points, std::vector<GridEdge> edges, const LoopWatch& watch,
                  SiteVoronoi& voronoi);

}  // namespace medial_vk
