#include "mesh/inspect_mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Number of groups that the triangles around a vertex form, joined over their edges there.
class FanCounter {
 public:
  FanCounter(const Mesh& mesh, const MeshTopology& topology) : mesh_(mesh), topology_(topology) {}

  std::uint32_t count(std::uint32_t vertex, std::span<const std::uint32_t> around) {
    sides_.clear();
    groups_.reset(around.size());
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      const Triangle& t = mesh_.triangles[around[i]];
      for (int k = 0; k < 3; ++k) {
        if (t[k] == vertex || t[(k + 1) % 3] == vertex) sides_.emplace_back(topology_.edge_of(around[i], k), i);
      }
    }
    std::sort(sides_.begin(), sides_.end());
    auto groups = static_cast<std::uint32_t>(around.size());
    for (std::size_t i = 1; i < sides_.size(); ++i) {
      if (sides_[i].first != sides_[i - 1].first) continue;
      if (groups_.join(sides_[i].second, sides_[i - 1].second)) --groups;
    }
    return groups;
  }

 private:
  const Mesh& mesh_;
  const MeshTopology& topology_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides_;  // edge, position in `around`
  DisjointSets groups_;                                         // of these positions
};

}  // namespace

std::vector<bool> inspect_topology(const Mesh& mesh, const MeshTopology& topology, MeshReport& report) {
  const std::size_t vertices = mesh.vertices.size();
  std::vector<bool> regular(vertices, true);
  bool cancels = true;
  report.open_edges = report.non_manifold_edges = report.inconsistent_edges = 0;
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto beside = topology.triangles_of(edge);
    const auto& ends = topology.ends(edge);
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (beside.size() == 1) ++report.open_edges;
    if (beside.size() == 2 && balance != 0) ++report.inconsistent_edges;
    if (beside.size() > 2) ++report.non_manifold_edges;
    cancels = cancels && balance == 0;
    for (const std::uint32_t v : ends) {
      if (beside.size() != 2 || balance != 0) regular[v] = false;
    }
  }
  report.closed = cancels;
  const VertexTriangles around(mesh);
  FanCounter fans(mesh, topology);
  report.non_manifold_vertices = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (fans.count(v, around.of(v)) > 1) {
      ++report.non_manifold_vertices;
      regular[v] = false;
    }
  }
  return regular;
}

void measure_box(const Mesh& mesh, MeshReport& report) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  report.lower = {kInfinity, kInfinity, kInfinity};
  report.upper = {-kInfinity, -kInfinity, -kInfinity};
  for (const Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      report.lower[k] = std::min(report.lower[k], p[k]);
      report.upper[k] = std::max(report.upper[k], p[k]);
    }
  }
}

Volumes measure_volumes(const Mesh& mesh, const SurfaceParts& parts, const Point& centre) {
  // The volume of a closed component does not depend on the origin: its own first corner loses the fewest digits.
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> origin(parts.components, kNone);
  std::vector<CompensatedSum> part(parts.components);
  CompensatedSum whole;
  double magnitude = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const std::uint32_t component = parts.component_of[i];
    if (origin[component] == kNone) origin[component] = t[0];
    const Point e = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Point f = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const Point area = cross(e, f);
    const Point a = mesh.vertices[t[0]] - mesh.vertices[origin[component]];
    part[component].add(dot(a, area));
    whole.add(dot(mesh.vertices[t[0]] - centre, area));
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      magnitude += std::abs(a[k]) * (std::abs(e[l] * f[m]) + std::abs(e[m] * f[l]));
    }
  }
  Volumes volumes;
  volumes.whole = whole.value() / 6;
  for (const CompensatedSum& sum : part) volumes.parts += std::abs(sum.value()) / 6;
  // A term carries 3u from its three differences, 2u from the cross and 3u from the dot product, each relative to the
  // magnitude that is summed here; the compensated sum adds 2u of the whole.
  volumes.parts_rounding = 12 * 0x1p-53 * magnitude / 6;
  return volumes;
}

std::optional<std::int64_t> euler_characteristic_of_solid(const PreparedMesh& mesh) {
  const MeshReport& report = mesh.report;
  if (!report.closed || report.non_manifold_edges > 0 || report.non_manifold_vertices > 0) return std::nullopt;
  const auto vertices = static_cast<std::int64_t>(mesh.mesh.vertices.size());
  const auto edges = static_cast<std::int64_t>(MeshTopology(mesh.mesh).edge_count());
  return (vertices - edges + static_cast<std::int64_t>(mesh.mesh.triangles.size())) / 2;
}

}  // namespace medial_vk
