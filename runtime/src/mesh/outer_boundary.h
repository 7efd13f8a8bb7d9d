// The boundary of the solid among the triangles of a mesh whose parts overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

struct OuterBoundary {
  Mesh mesh;
  std::vector<std::uint32_t> source;  ///< By triangle: the triangle of the given mesh.
  std::uint64_t cut_triangles = 0;    ///< Of the given mesh.
  std::uint64_t inner_triangles = 0;  ///< Left out, after the cut.
};

/// Cuts triangles along their crossings (cut_crossings()), and leaves out the patches that certainly lie inside: on
/// both sides of them the winding number is at least 1/2, or that of the other components alone is, so they do not
/// bound the solid. A patch is left out only if that opens nothing: at every edge, as many triangles remain on one side
/// as on the other, or no fewer than before. `component_of`: by triangle. Precondition: triangles are oriented as the
/// sides were decided.
OuterBoundary find_outer_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const TriangleTree& tree, const SelfIntersections& intersections, unsigned threads);

}  // namespace medial_vk
