// Self-intersections: triangles of a mesh that meet other triangles outside their shared vertices and edges.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

struct SelfIntersections {
  std::vector<bool> crossed;  ///< By triangle of the mesh.
  std::uint64_t count = 0;
  bool known = true;  ///< False: there were too many pairs to test, and `crossed` is not complete.
};

/// A triangle counts as crossed unless double arithmetic proves, against rounding, that it is disjoint from every other
/// triangle except for the vertices they share by index. Touching counts; so does folding back onto a neighbour.
/// The work is bounded by a number of pairs, not by a clock, so that the result is always the same.
SelfIntersections find_self_intersections(const Mesh& mesh, const TriangleTree& tree, unsigned threads = 0);

/// True if the triangles at two positions of the tree are proven to be disjoint except for vertices shared by index.
bool certainly_apart(const Mesh& mesh, const TriangleTree& tree, std::uint32_t i, std::uint32_t j);

/// The tests for two triangles that share no, one, or two vertices: true only if proven.
bool certainly_disjoint(const std::array<Point, 3>& a, const std::array<Point, 3>& b);
/// (apex, a1, a2) and (apex, b1, b2) meet at the apex only.
bool certainly_meet_at_apex(const Point& apex, const Point& a1, const Point& a2, const Point& b1, const Point& b2);
/// (p, q, a) and (p, q, b) meet at their common side only.
bool certainly_meet_at_side(const Point& p, const Point& q, const Point& a, const Point& b);

}  // namespace medial_vk
