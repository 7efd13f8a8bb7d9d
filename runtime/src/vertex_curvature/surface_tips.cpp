#include "vertex_curvature/surface_tips.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "medial_vk/bvh.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNowhere = 0xffffffffu;
constexpr std::size_t kTipsAtATime = 256;
constexpr std::size_t kMostNodes = 400;  // that are passed in search of tips
// A tip and its triangle differ in direction by as much as a facet does from the smooth boundary, and by 90 degrees or
// more where the tip is beyond the edge of a thin part.
constexpr double kSameSide = 0.3;

Point triangle_normal(const MeshView& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  double scale = 0;
  return double_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], scale);
}

}  // namespace

Eigen::Matrix3d shape_of(const TipCurvature& tip) {
  const Eigen::Vector3d u = to_eigen(tip.directions[0]), v = to_eigen(tip.directions[1]);
  return tip.kappa[0] * u * u.transpose() + tip.kappa[1] * v * v.transpose();
}

SurfaceTips::SurfaceTips(const IndexedMesh& mesh, std::span<const Ball> balls, const BoundaryCurvature& curvature,
                         unsigned threads, LoopWatch& watch)
    : mesh_(mesh.view()), graph_(mesh_, curvature.spacing) {
  std::vector<std::uint32_t> triangles(2 * balls.size(), kNowhere);
  std::vector<Point> positions(2 * balls.size());
  parallel_blocks(balls.size(), kTipsAtATime, threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        const TipCurvature& tip = curvature.balls[i].tips[side];
        if (!is_known(tip.state)) continue;
        const double reach = std::max(0.5 * balls[i].radius, curvature.spacing);
        const BvhHit hit = mesh.bvh().closest(balls[i].centre + balls[i].radius * tip.normal, reach);
        if (hit.triangle == kNowhere) continue;
        const Point normal = triangle_normal(mesh_, hit.triangle);
        if (dot(normal, tip.normal) < kSameSide * length(normal)) continue;
        triangles[2 * i + side] = hit.triangle;
        positions[2 * i + side] = hit.point;
      }
    }
    watch.finish(end - begin, balls.size());
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t at = 0; at < triangles.size(); ++at) {
    if (triangles[at] == kNowhere) continue;
    const TipCurvature& tip = curvature.balls[at / 2].tips[at % 2];
    for (const std::uint32_t corner : mesh_.triangles[triangles[at]]) {
      pairs.emplace_back(graph_.node_of(corner), static_cast<std::uint32_t>(tips_.size()));
    }
    tips_.push_back({positions[at], balls[at / 2], to_eigen(tip.normal), shape_of(tip),
                     std::isnan(tip.error) ? 0 : tip.error, static_cast<std::uint32_t>(at / 2),
                     static_cast<std::uint8_t>(at % 2)});
  }
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  by_node_ = IndexLists(graph_.size(), pairs);
  pairs.clear();
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh_.triangles[t]) pairs.emplace_back(vertex, static_cast<std::uint32_t>(t));
  }
  by_vertex_ = IndexLists(mesh_.vertices.size(), pairs);
  find_normals();
}

void SurfaceTips::find_normals() {
  normals_.resize(mesh_.vertices.size(), Point{0, 0, 0});
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Triangle& corners = mesh_.triangles[t];
    const Point normal = triangle_normal(mesh_, t);
    if (!(length(normal) > 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = mesh_.vertices[corners[k]];
      const Point a = mesh_.vertices[corners[(k + 1) % 3]] - p, b = mesh_.vertices[corners[(k + 2) % 3]] - p;
      const double angle = std::atan2(length(cross(a, b)), dot(a, b));
      normals_[corners[k]] = normals_[corners[k]] + (angle / length(normal)) * normal;
    }
  }
  for (Point& normal : normals_) {
    const double size = length(normal);
    normal = size > 0 ? (1 / size) * normal : Point{0, 0, 0};
  }
}

SurfaceWalk::SurfaceWalk(const SurfaceTips& tips)
    : surface_(tips), settled_(tips.graph().size()), seen_(tips.tips().size()) {}

void SurfaceWalk::visit(const Front& at) {
  const Point& here = surface_.place(at.node);
  for (const SurfaceGraph::Link& link : surface_.graph().links(at.node)) {
    const double path = at.path + link.length;
    if (settled_[link.node] == walk_ || path > most_) continue;
    front_.push_back({path, link.node});
    std::ranges::push_heap(front_, std::greater<>());
  }
  for (const std::uint32_t tip : surface_.of_node(at.node)) {
    if (has_seen(tip) || at.path + length(surface_.tips()[tip].position - here) > most_) continue;
    seen_[tip] = walk_;
    tips_.push_back(tip);
  }
}

void SurfaceWalk::begin(std::uint32_t vertex, double most) {
  ++walk_;
  most_ = most;
  tips_.clear();
  nodes_.clear();
  const SurfaceGraph& graph = surface_.graph();
  front_.assign(1, {graph.path_to_node(vertex), graph.node_of(vertex)});
}

bool SurfaceWalk::step(double limit) {
  while (!front_.empty() && front_.front().path <= limit) {
    std::ranges::pop_heap(front_, std::greater<>());
    const Front at = front_.back();
    front_.pop_back();
    if (settled_[at.node] == walk_) continue;
    settled_[at.node] = walk_;
    nodes_.push_back(at.node);
    visit(at);
    return true;
  }
  return false;
}

void SurfaceWalk::go_to(double path) {
  while (step(path)) {
  }
}

void SurfaceWalk::find_tips(std::size_t count) {
  while (tips_.size() < count && nodes_.size() < kMostNodes && step(most_)) {
  }
}

void SurfaceWalk::find_nodes(std::size_t count) {
  while (nodes_.size() < count && step(most_)) {
  }
}

}  // namespace medial_vk
