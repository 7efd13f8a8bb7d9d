// A simple tree of boxes over the triangles of a mesh, fast to build, for the search of crossings and for far-field
// sums.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

struct TreeBox {
  Point lower, upper;
};

inline bool overlap(const TreeBox& a, const TreeBox& b) {
  return a.lower[0] <= b.upper[0] && b.lower[0] <= a.upper[0] && a.lower[1] <= b.upper[1] && b.lower[1] <= a.upper[1] &&
         a.lower[2] <= b.upper[2] && b.lower[2] <= a.upper[2];
}

/// Triangles sorted along a Morton curve and split where its highest bit changes (Lauterbach 2009). Children follow
/// their parents in `nodes`.
struct TriangleTree {
  struct Node {
    TreeBox box;
    std::uint32_t first = 0, count = 0;  ///< Its triangles, as positions in `order`.
    std::uint32_t left = 0, right = 0;   ///< Children; 0: a leaf.
  };

  explicit TriangleTree(const Mesh& mesh);

  std::vector<Node> nodes;
  std::vector<std::uint32_t> order;           ///< By position: triangle of the mesh.
  std::vector<std::array<Point, 3>> corners;  ///< By position.
  std::vector<TreeBox> boxes;                 ///< By position.

 private:
  std::uint32_t add_node(const std::vector<std::uint64_t>& codes, std::uint32_t first, std::uint32_t count);
};

}  // namespace medial_vk
