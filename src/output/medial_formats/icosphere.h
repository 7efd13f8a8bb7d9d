// A unit sphere of triangles: a repeatedly subdivided icosahedron.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// All vertices are on the unit sphere around the origin, so the solid is inside it; triangles are counter-clockwise
/// from outside.
struct Icosphere {
  std::vector<Point> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The counts after `detail` subdivisions: 10 * 4^detail + 2 vertices and 20 * 4^detail triangles.
constexpr std::uint64_t icosphere_vertices(std::uint32_t detail) { return 10 * (1ull << 2 * detail) + 2; }
constexpr std::uint64_t icosphere_triangles(std::uint32_t detail) { return 20 * (1ull << 2 * detail); }

Icosphere make_icosphere(std::uint32_t detail);

/// The greatest distance from a point of the unit sphere to the facets below it.
double facet_depth(const Icosphere& sphere);

}  // namespace medial_vk
