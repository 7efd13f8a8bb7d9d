#include "medial_vk/bvh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "bvh/bvh_boxes.h"
#include "bvh/bvh_builder.h"
#include "bvh/nearby_triangles.h"
#include "bvh/triangle_distance.h"

namespace medial_vk {
namespace {

Error invalid_mesh(std::string message) { return {ErrorCode::kInvalidMesh, std::move(message)}; }

bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// Vertices or triangles in a block that a thread checks.
constexpr std::size_t kTrianglesOfBlock = 32768;

Status check_triangle(const MeshView& mesh, std::size_t triangle) {
  for (const std::uint32_t v : mesh.triangles[triangle]) {
    if (v >= mesh.vertices.size()) {
      return invalid_mesh("face " + std::to_string(triangle) + " uses vertex " + std::to_string(v) + " of " +
                          std::to_string(mesh.vertices.size()));
    }
    if (!is_finite(mesh.vertices[v])) {
      return invalid_mesh("vertex " + std::to_string(v) + " has a coordinate that is not finite");
    }
  }
  return {};
}

void lower_to(std::size_t value, std::atomic<std::size_t>& bound) {
  std::size_t present = bound.load();
  while (value < present && !bound.compare_exchange_weak(present, value)) {
  }
}

/// Names the first triangle that is at fault. Allocates nothing unless one is.
Status check_mesh(const MeshView& mesh, unsigned threads) {
  const std::size_t count = mesh.triangles.size();
  if (count == 0) return invalid_mesh("the mesh has no triangle");
  if (count >= 0x7fffffffu) return invalid_mesh("the mesh has more than 2147483646 triangles");
  std::atomic<std::size_t> first = count;
  parallel_blocks(count, kTrianglesOfBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < std::min(end, first.load()); ++t) {
      const Triangle& triangle = mesh.triangles[t];
      const bool fine = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
        return v < mesh.vertices.size() && is_finite(mesh.vertices[v]);
      });
      if (!fine) lower_to(t, first);
    }
  });
  return first < count ? check_triangle(mesh, first) : Status();
}

std::array<Point, 3> corners_of(const MeshView& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

BvhPrimitive make_primitive(const std::array<Point, 3>& corners, std::size_t triangle) {
  const auto& [a, b, c] = corners;
  const Point lower = least(a, least(b, c)), upper = greatest(a, greatest(b, c));
  return {{lower[0], lower[1], lower[2], -upper[0], -upper[1], -upper[2]}, static_cast<std::uint32_t>(triangle)};
}

std::vector<BvhPrimitive> make_primitives(const MeshView& mesh, unsigned threads) {
  std::vector<BvhPrimitive> primitives(mesh.triangles.size());
  parallel_blocks(primitives.size(), kTrianglesOfBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) primitives[t] = make_primitive(corners_of(mesh, t), t);
  });
  return primitives;
}

/// Depth-first walk, nearer child first. `limit()` is the squared distance beyond which a box is skipped (at the limit
/// it is not), `visit(position)` tests one triangle and returns true to end the walk.
template <class Limit, class Visit>
void walk_near_first(const std::vector<BvhNode>& nodes, const Point& p, Limit limit, Visit visit) {
  struct Pending {
    std::uint32_t node;
    double squared_distance;
  };
  std::array<Pending, Bvh::kMaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = {0, squared_distance(nodes[0].box, p)};
  while (size > 0) {
    const Pending top = stack[--size];
    if (top.squared_distance > limit()) continue;
    const BvhNode& node = nodes[top.node];
    if (node.count == 0) {
      Pending near{node.first, squared_distance(nodes[node.first].box, p)};
      Pending far{node.first + 1, squared_distance(nodes[node.first + 1].box, p)};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (visit(i)) return;
    }
  }
}

}  // namespace

Result<Bvh> Bvh::build(const MeshView& mesh, const BvhOptions& options) {
  const unsigned threads = thread_count(options.threads);
  return catch_out_of_memory("building a tree over the triangles", [&]() -> Result<Bvh> {
    if (Status status = check_mesh(mesh, threads); !status) return status.error();
    BvhBuilder builder(make_primitives(mesh, threads), std::max(1u, options.leaf_size), threads);
    Bvh bvh;
    bvh.nodes_ = builder.build();
    bvh.order_ = builder.take_order();
    bvh.corners_.resize(bvh.order_.size());
    bvh.take_corners(mesh, threads);
    return bvh;
  });
}

Result<Bvh> Bvh::refined(std::uint32_t leaf_size) const {
  return catch_out_of_memory("refining the tree over the triangles", [&]() -> Result<Bvh> {
    std::vector<BvhPrimitive> primitives(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) primitives[i] = make_primitive(corners_[i], order_[i]);
    BvhBuilder builder(std::move(primitives), std::max(1u, leaf_size), 1);
    Bvh fine;
    fine.nodes_ = builder.refine(nodes_);
    fine.order_ = builder.take_order();
    std::vector<std::uint32_t> position_of(order_.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) position_of[order_[i]] = i;
    fine.corners_.reserve(order_.size());
    for (const std::uint32_t triangle : fine.order_) fine.corners_.push_back(corners_[position_of[triangle]]);
    fit_boxes(fine.nodes_, fine.corners_, 1);
    return fine;
  });
}

Status Bvh::refit(const MeshView& mesh, const RefitOptions& options) {
  const unsigned threads = thread_count(options.threads);
  if (mesh.triangles.size() != order_.size()) {
    return invalid_mesh("the mesh has " + std::to_string(mesh.triangles.size()) +
                        " triangles, the tree was built over " + std::to_string(order_.size()));
  }
  if (order_.empty()) return {};
  return catch_out_of_memory("refitting the tree over the triangles", [&]() -> Status {
    if (Status status = check_mesh(mesh, threads); !status) return status;
    take_corners(mesh, threads);
    return {};
  });
}

void Bvh::take_corners(const MeshView& mesh, unsigned threads) {
  parallel_blocks(order_.size(), kTrianglesOfBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) corners_[i] = corners_of(mesh, order_[i]);
  });
  fit_boxes(nodes_, corners_, threads);
}

BvhHit Bvh::closest(const Point& p, double bound) const {
  BvhHit best;
  best.squared_distance = bound > 0 ? bound * bound : 0.0;
  walk_near_first(
      nodes_, p, [&] { return best.squared_distance; },
      [&](std::uint32_t i) {
        improve_hit(*this, p, i, best);
        return false;
      });
  if (best.triangle == 0xffffffffu) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

bool Bvh::any_within(const Point& centre, double radius) const {
  if (!(radius > 0)) return false;
  const double squared_radius = radius * radius;
  bool found = false;
  walk_near_first(
      nodes_, centre, [&] { return squared_radius; },
      [&](std::uint32_t i) {
        found = nearest_on_triangle(centre, corners_[i]).squared_distance < squared_radius;
        return found;
      });
  return found;
}

}  // namespace medial_vk
