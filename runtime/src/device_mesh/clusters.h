// Clusters of triangles, which the contact lists of large cells hold instead of single triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "device_mesh/device_tree.h"
#include "gpu_types.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

/// The largest subtrees of `bvh` of at most `most_triangles` in leaf order (`most_triangles` is at least 1; it is
/// doubled until there are no more than `most_clusters` of them; if subtrees of 4,096 are still too many, runs of equal
/// length are used instead), in the unit box, with all bounds rounded outwards. `flags` as MeshView::flags.
std::vector<gpu::Cluster> make_clusters(const Bvh& bvh, const UnitTransform& to_unit,
                                        std::span<const std::uint8_t> flags, std::uint32_t most_triangles,
                                        std::uint32_t most_clusters, unsigned threads = 0);

/// The median over the clusters of their radius around the middle of their cylinder. 0 if there are none.
float median_radius(std::span<const gpu::Cluster> clusters);

}  // namespace medial_vk
