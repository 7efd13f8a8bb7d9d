// The boundary of the solid among the triangles of a mesh whose parts overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/prepare.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/crossings/triangle_tree.h"
#include "mesh/inner_patches.h"

namespace medial_vk {

/// Fills holes that lie inside other parts (Holes), cuts the mesh (cut_crossings()), leaves out the patches inside
/// (leave_out_inner_patches(), for its parameters, too) and membranes outside (find_membranes()), and merges short
/// edges on crossings (merge_short_edges()).
OuterBoundary find_outer_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const TriangleTree& tree, const SelfIntersections& intersections,
                                  const PrepareOptions& options);

}  // namespace medial_vk
