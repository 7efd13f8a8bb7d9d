// A mesh whose triangles cross each other, cut along the crossings.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

struct CutMesh {
  std::vector<Point> vertices;        ///< Those of the mesh, then new ones on the crossings.
  std::vector<Triangle> triangles;    ///< Triangles that are cut are replaced by their parts.
  std::vector<std::uint32_t> source;  ///< By triangle: the triangle of the mesh.
  std::uint64_t cut_triangles = 0;    ///< Of the mesh.
  std::vector<bool> uncut;            ///< By triangle: it crosses others, but no cut was found. Empty: all are cut.
  /// The vertices at the positions for which crossings were decided: those above, or close to them in a degenerate
  /// position.
  std::vector<Point> decided;
};

/// Decisions are exact, for vertices rounded to 50 bits, and a point where triangles cross is one vertex of all of
/// them: the parts meet in vertices and edges only, up to the rounding of new vertices to double. In a degenerate
/// position (two triangles in one plane, a vertex on a triangle) decisions are those for vertices that are moved
/// outwards by at most 2^-32 of the longest side, and at random by less, so that parts that touch overlap; the vertices
/// themselves stay. Folds of neighbours onto each other are not cut. The mesh is returned as it is if nothing crosses,
/// or if no decision is found.
CutMesh cut_crossings(const Mesh& mesh, const TriangleTree& tree, const SelfIntersections& intersections,
                      unsigned threads);

}  // namespace medial_vk
