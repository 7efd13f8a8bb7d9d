#include "medial_mesh/mesh_topology_counts.h"

#include <algorithm>
#include <numeric>

namespace medial_vk {
namespace {

void sort_all(MedialMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::sort(t.begin(), t.end());
  for (MeshEdge& e : mesh.edges) std::sort(e.begin(), e.end());
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  std::sort(mesh.edges.begin(), mesh.edges.end());
}

std::vector<std::uint32_t> triangles_by_edge(const MedialMesh& mesh) {
  std::vector<std::uint32_t> counts(mesh.edges.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const MeshEdge& side : {MeshEdge{t[0], t[1]}, MeshEdge{t[0], t[2]}, MeshEdge{t[1], t[2]}}) {
      const auto found = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), side);
      ++counts[static_cast<std::size_t>(found - mesh.edges.begin())];
    }
  }
  return counts;
}

DualComplex complex_of(std::size_t points, const MedialMesh& mesh) {
  DualComplex complex;
  complex.vertices.resize(points);
  std::iota(complex.vertices.begin(), complex.vertices.end(), 0u);
  complex.edges = mesh.edges;
  complex.triangles = mesh.triangles;
  return complex;
}

}  // namespace

Status complete_medial_mesh(std::size_t points, const Sheets& sheets, MedialMesh& mesh) {
  sort_all(mesh);
  MedialTopology& topology = mesh.topology;
  const std::uint64_t hosted = topology.hosted_points;
  topology = {};
  topology.hosted_points = hosted;
  mesh.edge_marks.clear();
  const std::vector<std::uint32_t> counts = triangles_by_edge(mesh);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const MeshEdge& e = mesh.edges[i];
    const bool seam = counts[i] > 2 || sheets.of_point[e[0]] != sheets.of_point[e[1]];
    mesh.edge_marks.push_back(static_cast<std::uint8_t>((seam ? kSeam : 0) | (counts[i] == 1 ? kRim : 0)));
    if (counts[i] == 0) ++topology.bare_edges;
    if (counts[i] == 1) ++topology.boundary_edges;
    if (counts[i] > 2) ++topology.non_manifold_edges;
  }
  topology.bare_edges -= hosted;
  topology.euler_characteristic = static_cast<std::int64_t>(points) - static_cast<std::int64_t>(mesh.edges.size()) +
                                  static_cast<std::int64_t>(mesh.triangles.size());
  // Counted from the mesh itself, independently of the complex that it comes from.
  Result<BettiNumbers> betti = betti_numbers(complex_of(points, mesh));
  if (!betti) return betti.error();
  topology.betti = betti.value();
  return {};
}

}  // namespace medial_vk
