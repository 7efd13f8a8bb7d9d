#include "mesh/holes.h"

#include <unordered_map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/point_ops.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {
Holes::Holes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of) {
  const MeshTopology topology(mesh);
  ConnectedVertices connected;
  std::vector<char> is_repeated;
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto& [low, high] = topology.ends(edge);
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (balance == 0) continue;
    const std::uint32_t component = component_of[topology.triangles_of(edge).front()];
    edges_.push_back(balance > 0 ? OpenEdge{low, high, component, 0} : OpenEdge{high, low, component, 0});
    is_repeated.push_back(balance < -1 || balance > 1);
    connected.connect(low, high);
    if (edges_.size() > kMostOpenEdges) {
      edges_.clear();
      return;
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> hole_of_root;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    OpenEdge& e = edges_[i];
    const auto [known, is_new] = hole_of_root.try_emplace(connected.root(e.from), count());
    if (is_new) {
      apexes_.push_back({0, 0, 0});
      open_edges_.push_back(0);
      can_be_filled_.push_back(1);
    }
    e.hole = known->second;
    apexes_[e.hole] = apexes_[e.hole] + (mesh.vertices[e.from] + mesh.vertices[e.to]);
    ++open_edges_[e.hole];
    if (is_repeated[i]) can_be_filled_[e.hole] = 0;
  }
  for (std::uint32_t hole = 0; hole < count(); ++hole) {
    apexes_[hole] = (0.5 / static_cast<double>(open_edges_[hole])) * apexes_[hole];
    if (open_edges_[hole] > kMostOfOne) can_be_filled_[hole] = 0;
  }
}

Holes::Filled Holes::fill(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                          const std::vector<char>& wanted) const {
  Filled filled{mesh, component_of, {}};
  const auto first_apex = static_cast<std::uint32_t>(mesh.vertices.size());
  filled.mesh.vertices.insert(filled.mesh.vertices.end(), apexes_.begin(), apexes_.end());
  for (const OpenEdge& e : edges_) {
    if (!wanted[e.hole]) continue;
    filled.mesh.triangles.push_back({e.to, e.from, first_apex + e.hole});
    filled.component_of.push_back(e.component);
    filled.hole_of.push_back(e.hole);
  }
  return filled;
}

}  // namespace medial_vk
