// The incidence of triangles, edges and vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Undirected edges with any number of triangles. No triangle may repeat a corner. Positions do not matter, so it stays
/// valid when vertices move; turning a triangle over requires flip_triangle().
class MeshTopology {
 public:
  explicit MeshTopology(const Mesh& mesh);

  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(ends_.size()); }
  /// The edge from corner k to corner k + 1 of the triangle.
  std::uint32_t edge_of(std::uint32_t triangle, int k) const { return edge_of_[3 * std::size_t{triangle} + k]; }
  /// The smaller vertex first.
  const std::array<std::uint32_t, 2>& ends(std::uint32_t edge) const { return ends_[edge]; }
  std::span<const std::uint32_t> triangles_of(std::uint32_t edge) const {
    return {incident_.data() + starts_[edge], starts_[edge + 1] - starts_[edge]};
  }
  /// Follows the exchange of corners 1 and 2.
  void flip_triangle(std::uint32_t triangle) {
    std::swap(edge_of_[3 * std::size_t{triangle}], edge_of_[3 * std::size_t{triangle} + 2]);
  }

 private:
  std::vector<std::uint32_t> edge_of_;              // three per triangle
  std::vector<std::array<std::uint32_t, 2>> ends_;  // per edge
  std::vector<std::uint32_t> starts_, incident_;    // per edge: its triangles
};

/// True if the triangle traverses its side {low, high} from low to high.
inline bool runs_upwards(const Triangle& t, const std::array<std::uint32_t, 2>& ends) {
  return (t[0] == ends[0] && t[1] == ends[1]) || (t[1] == ends[0] && t[2] == ends[1]) ||
         (t[2] == ends[0] && t[0] == ends[1]);
}

/// How many more triangles traverse the edge from its smaller vertex to the other than back; 0: they cancel.
inline std::int64_t balance_at(const Mesh& mesh, const MeshTopology& topology, std::uint32_t edge) {
  std::int64_t balance = 0;
  for (const std::uint32_t t : topology.triangles_of(edge))
    balance += runs_upwards(mesh.triangles[t], topology.ends(edge)) ? 1 : -1;
  return balance;
}

/// The triangles around each vertex.
class VertexTriangles {
 public:
  explicit VertexTriangles(const Mesh& mesh);
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return {incident_.data() + starts_[vertex], starts_[vertex + 1] - starts_[vertex]};
  }

 private:
  std::vector<std::uint32_t> starts_, incident_;
};

}  // namespace medial_vk
