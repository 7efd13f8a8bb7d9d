#include "solid/closing_surface.h"

#include <cstdlib>
#include <map>
#include <unordered_map>
#include <utility>

#include "base/connected_vertices.h"
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

Mesh close(const Mesh& mesh, const MeshTopology& topology) {
  struct OpenEdge {
    std::uint32_t edge;
    std::int64_t balance;
  };
  std::vector<OpenEdge> open;
  ConnectedVertices connected;
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (balance == 0) continue;
    open.push_back({edge, balance});
    connected.connect(topology.ends(edge)[0], topology.ends(edge)[1]);
  }
  Mesh closing;
  std::map<std::uint32_t, Hole> holes;                         // by root
  std::unordered_map<std::uint32_t, std::uint32_t> number_of;  // by vertex of the mesh
  const auto number = [&](std::uint32_t v) {
    const auto [known, is_new] = number_of.try_emplace(v, static_cast<std::uint32_t>(closing.vertices.size()));
    if (is_new) closing.vertices.push_back(mesh.vertices[v]);
    return known->second;
  };
  for (const OpenEdge& e : open) {
    const auto& [low, high] = topology.ends(e.edge);
    holes[connected.root(low)].add(mesh.vertices[low], mesh.vertices[high]);
  }
  for (auto& [root, hole] : holes) {
    hole.apex = static_cast<std::uint32_t>(closing.vertices.size());
    closing.vertices.push_back(hole.apex_position());
  }
  for (const OpenEdge& e : open) {
    const auto& [low, high] = topology.ends(e.edge);
    // Against the direction in which the mesh traverses the edge more often.
    const std::uint32_t from = number(e.balance > 0 ? high : low), to = number(e.balance > 0 ? low : high);
    const std::uint32_t apex = holes[connected.root(low)].apex;
    for (std::int64_t times = std::abs(e.balance); times > 0; --times) closing.triangles.push_back({from, to, apex});
  }
  return closing;
}

}  // namespace

ClosingSurface::ClosingSurface(Mesh mesh, Bvh bvh)
    : mesh_(std::move(mesh)), bvh_(std::move(bvh)), tree_(mesh_), winding_(tree_) {}

Result<std::unique_ptr<ClosingSurface>> ClosingSurface::build(const Mesh& mesh, const MeshTopology& topology) {
  Mesh closing = close(mesh, topology);
  if (closing.triangles.empty()) return std::unique_ptr<ClosingSurface>();
  Result<Bvh> bvh = Bvh::build({closing.vertices, closing.triangles, {}, false}, {4, 1});
  if (!bvh) return bvh.error();
  return std::unique_ptr<ClosingSurface>(new ClosingSurface(std::move(closing), std::move(bvh).value()));
}

}  // namespace medial_vk
