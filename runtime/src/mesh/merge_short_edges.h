// Crossings that lie almost on top of each other, or of a vertex, become one vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// The length of edges that are merged, of the longest side: just below the error of a distance on a device, 2e-6.
constexpr double kMergedLength = 0x1p-19;

/// Merges the ends of edges shorter than `length` if one of them is a vertex from `first_new` on, which is moved onto
/// the other; triangles at the edge vanish, from `source`, too. No vertex moves by more than `length` in all. An edge
/// stays if the surface would touch itself without it, or if a triangle would turn over. Parts that are aligned, as
/// symmetric models are, cross in pairs of points closer than this; the slivers between them separate faces that belong
/// side by side.
void merge_short_edges(Mesh& mesh, std::vector<std::uint32_t>& source, std::size_t first_new, double length);

}  // namespace medial_vk
