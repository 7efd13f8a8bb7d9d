#include "medial_vk/medial_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "medial_mesh/collapse.h"
#include "medial_mesh/mesh_topology_counts.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

class Builder {
 public:
  Builder(const VoxelGraph& graph, const MedialMeshOptions& options)
      : graph_(graph), options_(options), hosts_(graph.size(), kNone) {
    for (std::uint32_t position = 0; position < graph.size(); ++position) find_leader(position);
  }

  Result<MedialMesh> run() {
    Result<BallUnion> grown = measure_ball_union(grown_balls(), {options_.threads, true});
    if (!grown) return grown.error();
    const DualComplex surface = collapse_to_surface(grown.value().complex, rule());
    host_hidden(surface.vertices);
    MedialMesh mesh;
    for (const auto& [a, b, c] : surface.triangles) {
      mesh.triangles.push_back({graph_.index(a), graph_.index(b), graph_.index(c)});
    }
    for (const auto& [a, b] : surface.edges) mesh.edges.push_back({graph_.index(a), graph_.index(b)});
    for (std::uint32_t position = 0; position < graph_.size(); ++position) {
      if (hosts_[position] == kNone) continue;
      mesh.edges.push_back({graph_.index(position), graph_.index(hosts_[position])});
      ++mesh.topology.hosted_points;
    }
    return mesh;
  }

 private:
  double squared_distance(std::uint32_t a, std::uint32_t b) const {
    const Point d = graph_.sphere(a).centre - graph_.sphere(b).centre;
    return dot(d, d);
  }

  /// Points close together at the wall between two voxels are copies of one point of the medial surface, in an
  /// arbitrary order along the normal. The first of them that has no representative itself represents them.
  void find_leader(std::uint32_t position) {
    const double reach = 2 * options_.epsilon;
    for (const std::uint32_t other : graph_.neighbours(position)) {
      if (other > position) return;
      if (hosts_[other] != kNone || squared_distance(position, other) > reach * reach) continue;
      hosts_[position] = other;
      return;
    }
  }

  /// By position. All powers change by the same amount, so that the power diagram is that of the balls themselves.
  std::vector<Ball> grown_balls() const {
    std::vector<Ball> balls;
    balls.reserve(graph_.size());
    for (std::uint32_t position = 0; position < graph_.size(); ++position) {
      const MedialSphere& sphere = graph_.sphere(position);
      // A ball without a radius is no part of the complex.
      const double radius = hosts_[position] == kNone ? std::hypot(sphere.radius, options_.growth) : 0;
      balls.push_back({sphere.centre, radius});
    }
    return balls;
  }

  CollapseRule rule() const {
    return {[this](std::uint32_t a, std::uint32_t b) { return squared_distance(a, b); },
            [this](std::uint32_t a, std::uint32_t b) { return graph_.touch(a, b); }};
  }

  /// A ball without a share of the union: the ball in whose power cell its centre lies is its host.
  void host_hidden(const std::vector<std::uint32_t>& vertices) {
    for (std::uint32_t position = 0, n = 0; position < graph_.size(); ++position) {
      while (n < vertices.size() && vertices[n] < position) ++n;
      const bool is_vertex = n < vertices.size() && vertices[n] == position;
      if (!is_vertex && hosts_[position] == kNone) hosts_[position] = vertex_of_least_power(position, vertices);
    }
  }

  std::uint32_t vertex_of_least_power(std::uint32_t position, const std::vector<std::uint32_t>& vertices) const {
    std::uint32_t host = kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t vertex : vertices) {
      const double radius = graph_.sphere(vertex).radius;
      const double power = squared_distance(position, vertex) - radius * radius;
      if (power >= least) continue;
      least = power;
      host = vertex;
    }
    return host;
  }

  const VoxelGraph& graph_;
  const MedialMeshOptions& options_;
  // by position: the point that represents it, or none if it is a vertex of the complex
  std::vector<std::uint32_t> hosts_;
};

}  // namespace

Result<MedialMesh> make_medial_mesh(std::span<const MedialSphere> spheres, const Sheets& sheets,
                                    const MedialMeshOptions& options) {
  const auto is_length = [](double x) { return x >= 0 && std::isfinite(x); };
  if (!is_length(options.growth) || !is_length(options.epsilon)) {
    return Error{ErrorCode::kUsage, "`growth` and `epsilon` must be lengths of 0 or more"};
  }
  return catch_out_of_memory("joining medial points", [&]() -> Result<MedialMesh> {
    const VoxelGraph graph(spheres, options.threads);
    Result<MedialMesh> mesh = Builder(graph, options).run();
    if (!mesh) return mesh;
    if (const Status status = complete_medial_mesh(spheres.size(), sheets, mesh.value()); !status) {
      return status.error();
    }
    return mesh;
  });
}

}  // namespace medial_vk
