// The patches of a cut mesh that do not bound the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/cut_crossings.h"

namespace medial_vk {

struct OuterBoundary {
  Mesh mesh;
  std::vector<std::uint32_t> source;  ///< By triangle: the triangle of the given mesh.
  std::uint64_t cut_triangles = 0;    ///< Of the given mesh.
  std::uint64_t inner_triangles = 0;  ///< Left out, after the cut.
  std::uint64_t outer_triangles = 0;  ///< Of membranes, likewise.
  /// Open edges of the given mesh at holes that were filled, as their fillings lie inside.
  std::uint64_t hidden_open_edges = 0;
};

/// The components of a mesh before the cut.
struct CutComponents {
  std::vector<std::uint32_t> of_triangle;
  std::vector<char> is_membrane;  ///< By component: it encloses nothing (find_membranes()). Empty: none is.
  bool keep_outer = false;        ///< Keep the patches of membranes that lie outside.
};

/// Leaves out the patches of a cut mesh that certainly lie inside: on both sides of them the winding number is at least
/// 1/2, or that of the other components alone is, so they do not bound the solid. Membranes do not count in winding
/// numbers. A patch stays if it has a triangle that crosses others, and at edges with patches that stay if the boundary
/// would be open there without it, unless it is a membrane. The patches of membranes that certainly lie outside are
/// left out, too (docs/theory.md, "The boundary of overlapping parts"). Precondition: triangles are oriented as the
/// sides were decided.
OuterBoundary leave_out_inner_patches(CutMesh cut, const CutComponents& components, unsigned threads);

/// By triangle of the cut mesh: 1 if its patch lies inside and has a triangle whose source is `first` or later; others
/// are not examined. Edges with patches that stay are not, either.
std::vector<char> lie_inside(CutMesh cut, const CutComponents& components, std::size_t first, unsigned threads);

}  // namespace medial_vk
