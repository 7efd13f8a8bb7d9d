// The paths along the edges of a mesh, as coarse as curvatures need them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/mesh.h"
#include "vertex_curvature/index_lists.h"

namespace medial_vk {

/// Nodes are vertices such that every vertex has one within a path of the length `apart`. Where edges are longer, each
/// vertex is a node, and links are edges. So the nodes within a path are no more than the balls along it, however fine
/// the mesh is.
class SurfaceGraph {
 public:
  struct Link {
    std::uint32_t node;
    double length;  ///< Of the shortest path from node to node across one edge between their vertices.
  };

  SurfaceGraph() = default;
  SurfaceGraph(const MeshView& mesh, double apart);

  std::size_t size() const { return vertices_.size(); }
  std::span<const Link> links(std::uint32_t node) const {
    return {links_.data() + starts_[node], starts_[node + 1] - starts_[node]};
  }
  std::uint32_t vertex(std::uint32_t node) const { return vertices_[node]; }
  /// The node that stands for a vertex, and the length of the path to it.
  std::uint32_t node_of(std::uint32_t vertex) const { return nodes_[vertex]; }
  double path_to_node(std::uint32_t vertex) const { return paths_[vertex]; }

 private:
  void find_nodes(const MeshView& mesh, const IndexLists& neighbours, double apart);
  void find_links(const MeshView& mesh, const IndexLists& neighbours);

  std::vector<std::uint32_t> vertices_, nodes_;
  std::vector<double> paths_;
  std::vector<std::size_t> starts_;
  std::vector<Link> links_;
};

}  // namespace medial_vk
