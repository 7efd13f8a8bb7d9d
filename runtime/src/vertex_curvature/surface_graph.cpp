#include "vertex_curvature/surface_graph.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// By vertex, those at the other ends of its edges.
IndexLists neighbours_of(const MeshView& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(6 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      pairs.emplace_back(t[k], t[(k + 1) % 3]);
      pairs.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return {mesh.vertices.size(), pairs};
}

}  // namespace

SurfaceGraph::SurfaceGraph(const MeshView& mesh, double apart) {
  const IndexLists neighbours = neighbours_of(mesh);
  find_nodes(mesh, neighbours, apart);
  find_links(mesh, neighbours);
}

/// Shortest paths from one node after the other, each as far as no other node is nearer.
void SurfaceGraph::find_nodes(const MeshView& mesh, const IndexLists& neighbours, double apart) {
  using Front = std::pair<double, std::uint32_t>;
  std::vector<Front> front;
  nodes_.resize(mesh.vertices.size());
  paths_.assign(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  vertices_.reserve(mesh.vertices.size());
  for (std::uint32_t first = 0; first < paths_.size(); ++first) {
    if (paths_[first] < apart) continue;
    const auto node = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(first);
    nodes_[first] = node;
    paths_[first] = 0;
    front.assign(1, {0, first});
    while (!front.empty()) {
      std::ranges::pop_heap(front, std::greater<>());
      const auto [path, vertex] = front.back();
      front.pop_back();
      if (path > paths_[vertex]) continue;
      for (const std::uint32_t next : neighbours[vertex]) {
        const double longer = path + length(mesh.vertices[next] - mesh.vertices[vertex]);
        if (!(longer < apart) || longer >= paths_[next]) continue;
        nodes_[next] = node;
        paths_[next] = longer;
        front.emplace_back(longer, next);
        std::ranges::push_heap(front, std::greater<>());
      }
    }
  }
}

void SurfaceGraph::find_links(const MeshView& mesh, const IndexLists& neighbours) {
  struct Edge {
    std::uint32_t from, to;
    double length;
    auto operator<=>(const Edge&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
  };
  std::vector<Edge> edges;
  edges.reserve(6 * vertices_.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const std::uint32_t next : neighbours[v]) {
      if (nodes_[v] == nodes_[next]) continue;
      const double across = length(mesh.vertices[next] - mesh.vertices[v]);
      edges.push_back({nodes_[v], nodes_[next], paths_[v] + across + paths_[next]});
    }
  }
  std::ranges::sort(edges);  // of equal ends, the shortest one first
  const auto have_same_ends = [](const Edge& a, const Edge& b) { return a.from == b.from && a.to == b.to; };
  edges.erase(std::unique(edges.begin(), edges.end(), have_same_ends), edges.end());
  starts_.assign(vertices_.size() + 1, 0);
  links_.reserve(edges.size());
  for (const Edge& edge : edges) {
    ++starts_[edge.from + 1];
    links_.push_back({edge.to, edge.length});
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) starts_[i + 1] += starts_[i];
}

}  // namespace medial_vk
