#include "vertex_curvature/voronoi_means.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "curvature/point_grid.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffu;

/// The nearest vertex that faces the same way as the tip. Where a wall is thinner than its triangles are long, the
/// nearest vertex of all may be on its other side.
class FacingVertices {
 public:
  explicit FacingVertices(const SurfaceTips& tips) : tips_(tips), grid_(tips.mesh().vertices, mean_edge(tips.mesh())) {
    Point lower = tips.mesh().vertices[0], upper = lower;
    for (const Point& p : tips.mesh().vertices) {
      lower = least(lower, p);
      upper = greatest(upper, p);
    }
    most_reach_ = length(upper - lower);
    constexpr double kLeastShare = 1e-6;  // else a mesh whose edges have no length would have no last reach
    first_reach_ = std::max(mean_edge(tips.mesh()), kLeastShare * most_reach_);
  }

  std::uint32_t of(const SurfaceTip& tip) const {
    const Point normal = to_point(tip.normal);
    for (double reach = first_reach_;; reach *= 2) {
      std::uint32_t nearest = kNoVertex;
      double distance = std::numeric_limits<double>::infinity();
      grid_.visit_within(tip.position, reach, [&](std::uint32_t vertex, double squared) {
        if (squared > distance || (squared == distance && vertex > nearest)) return;
        if (!(dot(tips_.normal(vertex), normal) > 0)) return;
        distance = squared;
        nearest = vertex;
      });
      if (nearest != kNoVertex || reach > most_reach_) return nearest;
    }
  }

 private:
  static double mean_edge(const MeshView& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) sum += length(mesh.vertices[t[1]] - mesh.vertices[t[0]]);
    return sum / static_cast<double>(mesh.triangles.size());
  }

  const SurfaceTips& tips_;
  PointGrid grid_;
  double first_reach_ = 0, most_reach_ = 0;
};

/// Of the tips in the cell of a vertex.
VertexCurvature mean_of(const SurfaceTips& surface, const BoundaryCurvature& curvature, std::size_t vertex,
                        std::span<const std::uint32_t> members) {
  VertexCurvature out;
  out.normal = surface.normal(vertex);
  if (members.empty()) return out;
  out.state = CurvatureState::kKnown;
  const Eigen::Vector3d normal = to_eigen(out.normal);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  std::array<double, 2> sum = {0, 0}, squares = {0, 0};
  double error = 0, nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t member : members) {
    const SurfaceTip& tip = surface.tips()[member];
    const TipCurvature& known = curvature.balls[tip.ball].tips[tip.side];
    for (std::size_t k = 0; k < 2; ++k) {
      sum[k] += known.kappa[k];
      squares[k] += known.kappa[k] * known.kappa[k];
    }
    const Eigen::Vector3d axis = to_eigen(known.directions[0]);
    const Eigen::Vector3d flat = axis - axis.dot(normal) * normal;
    axes += flat * flat.transpose();
    error += tip.error;
    const Point offset = tip.position - surface.mesh().vertices[vertex];
    if (dot(offset, offset) >= nearest) continue;
    nearest = dot(offset, offset);
    out.ball = tip.ball;
    out.tip = tip.side;
  }
  const auto count = static_cast<double>(members.size());
  double variance = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    out.kappa[k] = sum[k] / count;
    variance = std::max(variance, squares[k] / count - out.kappa[k] * out.kappa[k]);
  }
  out.error = error / count + std::sqrt(variance);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(axes);
  const Eigen::Vector3d first = solver.eigenvectors().col(2);
  out.directions = {to_point(first), to_point(normal.cross(first))};
  return out;
}

/// In rounds: vertices beside those with values get the mean of theirs.
void propagate(const SurfaceTips& surface, std::vector<VertexCurvature>& out, LoopWatch& watch) {
  const MeshView& mesh = surface.mesh();
  std::vector<std::uint32_t> open, next, found;
  std::vector<std::array<double, 2>> values;
  std::vector<std::uint32_t> neighbours;
  for (std::uint32_t v = 0; v < out.size(); ++v) {
    if (!is_known(out[v].state)) open.push_back(v);
  }
  while (!open.empty()) {
    watch.check();
    next.clear();
    found.clear();
    values.clear();
    for (const std::uint32_t v : open) {
      neighbours.clear();
      for (const std::uint32_t triangle : surface.triangles_at(v)) {
        for (const std::uint32_t corner : mesh.triangles[triangle]) {
          if (is_known(out[corner].state)) neighbours.push_back(corner);
        }
      }
      std::ranges::sort(neighbours);
      neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      if (neighbours.empty()) {
        next.push_back(v);
        continue;
      }
      std::array<double, 2> sum = {0, 0};
      for (const std::uint32_t corner : neighbours) {
        for (std::size_t k = 0; k < 2; ++k) sum[k] += out[corner].kappa[k];
      }
      const auto count = static_cast<double>(neighbours.size());
      found.push_back(v);
      values.push_back({sum[0] / count, sum[1] / count});
    }
    if (found.empty()) return;
    for (std::size_t i = 0; i < found.size(); ++i) {
      out[found[i]].state = CurvatureState::kCut;
      out[found[i]].kappa = values[i];
    }
    open.swap(next);
  }
}

}  // namespace

std::vector<VertexCurvature> voronoi_means(const SurfaceTips& tips, const BoundaryCurvature& curvature,
                                           unsigned threads, LoopWatch& watch) {
  const std::size_t count = tips.mesh().vertices.size();
  const FacingVertices vertices(tips);
  std::vector<std::uint32_t> cells(tips.tips().size());
  parallel_blocks(cells.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    for (std::size_t i = begin; i < end; ++i) cells[i] = vertices.of(tips.tips()[i]);
    watch.finish(end - begin, cells.size());
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != kNoVertex) pairs.emplace_back(cells[i], i);
  }
  const IndexLists members(count, pairs);
  std::vector<VertexCurvature> out;
  out.reserve(count);
  for (std::size_t v = 0; v < count; ++v) out.push_back(mean_of(tips, curvature, v, members[v]));
  propagate(tips, out, watch);
  return out;
}

}  // namespace medial_vk
