// Sites as one mesh, for those who draw them.
#pragma once

#include <cstdint>
#include <span>

#include "medial_vk/mesh.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk {

enum class BoxCorners : std::uint8_t { kUnmarked, kMarked };

/// Triangles that stand for sites of any kind: those of meshes and of triangles, and thin prisms for segments and
/// points. With kMarked there is a speck at each corner of the box of the grid, which frames all of it.
Mesh mesh_of_sites(const SiteGrid& grid, std::span<const VoronoiSite> sites, BoxCorners corners);

/// Of the box of the grid, in input units.
double diagonal_of(const SiteGrid& grid);

}  // namespace medial_vk
