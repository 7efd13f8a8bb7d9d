// The boundary of the solid among the triangles of a mesh whose parts overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/cut_crossings.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

struct OuterBoundary {
  Mesh mesh;
  std::vector<std::uint32_t> source;  ///< By triangle: the triangle of the given mesh.
  std::uint64_t cut_triangles = 0;    ///< Of the given mesh.
  std::uint64_t inner_triangles = 0;  ///< Left out, after the cut.
  /// Open edges of the given mesh at holes that were filled, as their fillings lie inside.
  std::uint64_t hidden_open_edges = 0;
};

/// Leaves out the patches of a cut mesh that certainly lie inside: on both sides of them the winding number is at least
/// 1/2, or that of the other components alone is, so they do not bound the solid. A patch stays if it has a triangle
/// that crosses others, and at edges with patches that stay if the boundary would be open there without it
/// (docs/theory.md, "The boundary of overlapping parts"). `component_of`: by triangle of the mesh before the cut.
/// Precondition: triangles are oriented as the sides were decided.
OuterBoundary leave_out_inner_patches(CutMesh cut, const std::vector<std::uint32_t>& component_of, unsigned threads);

/// The same for a mesh, which is cut first (cut_crossings()). Holes that lie inside other parts are filled before
/// (Holes), and short edges on crossings are merged at last (merge_short_edges()).
OuterBoundary find_outer_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const TriangleTree& tree, const SelfIntersections& intersections, unsigned threads);

}  // namespace medial_vk
