// The segments in which triangles of a mesh cross each other, and their end points.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/exact_points.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

/// The crossing of a triangle with another one: between two points, where a point below the number of vertices of
/// the mesh is a vertex, and all others are new points.
struct CrossingSegment {
  std::uint32_t from, to;
  std::uint32_t other;  ///< The triangle that crosses.
};

struct Crossings {
  std::vector<ExactPoint> points;                      ///< New points, from the number of vertices on.
  std::vector<std::vector<CrossingSegment>> segments;  ///< By triangle.
  std::vector<std::vector<std::uint32_t>> inside;      ///< By triangle: points where its segments cross each other.
  /// The new points on an edge, by its vertices, the smaller first.
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> on_edges;
};

/// The positions for which crossings are decided.
struct GridPositions {
  std::vector<Point> of_vertex;  ///< On the grid of ExactGeometry.
  /// The greatest distance of vertices from where they are in the mesh, in its units. 0: only pairs of triangles that
  /// cross or touch there are tested.
  double moved = 0;
};

/// `crossed`: the triangles of the mesh that cross or touch others. Without a value if the position is degenerate, as
/// where a vertex lies on a triangle or two triangles lie in one plane.
std::optional<Crossings> find_crossings(const Mesh& mesh, const GridPositions& grid, const TriangleTree& tree,
                                        const std::vector<bool>& crossed, unsigned threads);

}  // namespace medial_vk
