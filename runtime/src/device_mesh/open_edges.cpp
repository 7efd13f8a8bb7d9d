#include "device_mesh/open_edges.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/disjoint_sets.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

struct DirectedEdge {
  std::uint32_t low, high;
  int direction;  // +1: from low to high
};

std::vector<DirectedEdge> directed_edges(const MeshView& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::ranges::sort(edges, {}, [](const DirectedEdge& e) { return std::pair(e.low, e.high); });
  return edges;
}

// An edge that is traversed from `from` to `to` by that much more often than back.
struct Surplus {
  std::uint32_t from, to;
  int times;
};

std::vector<Surplus> surpluses(const MeshView& mesh) {
  const std::vector<DirectedEdge> edges = directed_edges(mesh);
  std::vector<Surplus> out;
  for (std::size_t i = 0; i < edges.size();) {
    int sum = 0;
    const DirectedEdge& e = edges[i];
    for (; i < edges.size() && edges[i].low == e.low && edges[i].high == e.high; ++i) sum += edges[i].direction;
    if (sum > 0) out.push_back({e.low, e.high, sum});
    if (sum < 0) out.push_back({e.high, e.low, -sum});
  }
  return out;
}

}  // namespace

OpenEdges find_open_edges(const MeshView& mesh, const UnitTransform& to_unit, std::uint32_t most) {
  const std::vector<Surplus> edges = surpluses(mesh);
  OpenEdges out;
  out.count = static_cast<std::uint32_t>(edges.size());
  if (out.count > most) return out;
  ConnectedVertices parts;
  for (const Surplus& e : edges) parts.connect(e.from, e.to);
  struct Mean {
    Point sum{};
    double count = 0;
  };
  std::map<std::uint32_t, Mean> apexes;
  for (const Surplus& e : edges) {
    Mean& mean = apexes[parts.root(e.from)];
    mean.sum = mean.sum + to_unit(mesh.vertices[e.from]) + to_unit(mesh.vertices[e.to]);
    mean.count += 2;
  }
  for (const Surplus& e : edges) {
    const Mean& mean = apexes[parts.root(e.from)];
    // The triangle that closes the mesh runs back.
    out.listed.push_back({to_vec4(to_unit(mesh.vertices[e.to]), e.times), to_vec4(to_unit(mesh.vertices[e.from]), 0),
                          to_vec4((1 / mean.count) * mean.sum, 0)});
  }
  return out;
}

}  // namespace medial_vk
