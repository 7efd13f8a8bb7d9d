#include "solid/closing_surface.h"

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Open edges that are connected, and their apex.
struct Hole {
  Point sum = {0, 0, 0}, reach = {0, 0, 0};
  double edges = 0;
  std::uint32_t apex = 0;

  void add(const Point& from, const Point& to) {
    sum = sum + 0.5 * (from + to);
    reach = greatest(reach, greatest(from - to, to - from));
    ++edges;
  }
  /// Not in the mean of the edges: searches on symmetric meshes begin there.
  Point apex_position() const {
    return (1 / edges) * sum + Point{0.311 * reach[0], 0.173 * reach[1], 0.237 * reach[2]};
  }
};

struct OpenEdge {
  std::uint32_t from, to;  // against the direction in which the mesh traverses the edge more often
  std::int64_t times;
};

std::vector<OpenEdge> find_open_edges(const Mesh& mesh, const MeshTopology& topology) {
  std::vector<OpenEdge> open;
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto& [low, high] = topology.ends(edge);
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (balance > 0) open.push_back({high, low, balance});
    if (balance < 0) open.push_back({low, high, -balance});
  }
  return open;
}

Mesh close(const Mesh& mesh, const std::vector<OpenEdge>& open) {
  ConnectedVertices connected;
  for (const OpenEdge& e : open) connected.connect(e.from, e.to);
  std::map<std::uint32_t, Hole> holes;  // by root
  for (const OpenEdge& e : open) holes[connected.root(e.from)].add(mesh.vertices[e.from], mesh.vertices[e.to]);
  Mesh closing;
  for (auto& [root, hole] : holes) {
    hole.apex = static_cast<std::uint32_t>(closing.vertices.size());
    closing.vertices.push_back(hole.apex_position());
  }
  std::unordered_map<std::uint32_t, std::uint32_t> number_of;  // by vertex of the mesh
  const auto number = [&](std::uint32_t v) {
    const auto [known, is_new] = number_of.try_emplace(v, static_cast<std::uint32_t>(closing.vertices.size()));
    if (is_new) closing.vertices.push_back(mesh.vertices[v]);
    return known->second;
  };
  for (const OpenEdge& e : open) {
    const Triangle corners = {number(e.from), number(e.to), holes[connected.root(e.from)].apex};
    closing.triangles.insert(closing.triangles.end(), static_cast<std::size_t>(e.times), corners);
  }
  return closing;
}

}  // namespace

ClosingSurface::ClosingSurface(Mesh mesh, Bvh bvh)
    : mesh_(std::move(mesh)), bvh_(std::move(bvh)), tree_(mesh_), winding_(tree_) {}

Result<std::unique_ptr<ClosingSurface>> ClosingSurface::build(const Mesh& mesh, const MeshTopology& topology) {
  Mesh closing = close(mesh, find_open_edges(mesh, topology));
  if (closing.triangles.empty()) return std::unique_ptr<ClosingSurface>();
  Result<Bvh> bvh = Bvh::build({closing.vertices, closing.triangles, {}, false}, {4, 1});
  if (!bvh) return bvh.error();
  return std::unique_ptr<ClosingSurface>(new ClosingSurface(std::move(closing), std::move(bvh).value()));
}

}  // namespace medial_vk
