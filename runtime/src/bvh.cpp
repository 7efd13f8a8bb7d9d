#include "medial_vk/bvh.h"

#include <cmath>
#include <string>
#include <thread>

#include "bvh_builder.h"
#include "point_math.h"
#include "triangle_distance.h"

namespace medial_vk {
namespace {

Error invalid_mesh(std::string message) { return {ErrorCode::kInvalidMesh, std::move(message)}; }

bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

Status check_mesh(const MeshView& mesh) {
  if (mesh.triangles.empty()) return invalid_mesh("the mesh has no triangle");
  if (mesh.triangles.size() >= 0x7fffffffu) return invalid_mesh("the mesh has more than 2147483646 triangles");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.vertices.size()) {
        return invalid_mesh("face " + std::to_string(t) + " uses vertex " + std::to_string(v) + " of " +
                            std::to_string(mesh.vertices.size()));
      }
      if (!is_finite(mesh.vertices[v])) {
        return invalid_mesh("vertex " + std::to_string(v) + " has a coordinate that is not finite");
      }
    }
  }
  return {};
}

std::array<Point, 3> corners_of(const MeshView& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

std::vector<BvhPrimitive> make_primitives(const MeshView& mesh) {
  std::vector<BvhPrimitive> primitives(mesh.triangles.size());
  for (std::size_t t = 0; t < primitives.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    primitives[t] = {{least(a, least(b, c)), greatest(a, greatest(b, c))}, static_cast<std::uint32_t>(t)};
  }
  return primitives;
}

double squared_distance(const BvhBox& box, const Point& p) {
  const Point outside = greatest(greatest(box.lower - p, p - box.upper), Point{0, 0, 0});
  return dot(outside, outside);
}

/// Depth-first walk, nearer child first. `limit()` is the squared distance beyond which a box is of no interest (at
/// the limit it is), `visit(position)` looks at one triangle and returns true to end the walk.
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

Result<Bvh> Bvh::build(const MeshView& mesh, std::uint32_t leaf_size, unsigned threads) {
  if (Status status = check_mesh(mesh); !status) return status.error();
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<BvhPrimitive> primitives = make_primitives(mesh);
  Bvh bvh;
  bvh.nodes_ = BvhBuilder(primitives, std::max(1u, leaf_size), threads).build();
  bvh.order_.reserve(primitives.size());
  bvh.corners_.reserve(primitives.size());
  for (const BvhPrimitive& primitive : primitives) {
    bvh.order_.push_back(primitive.triangle);
    bvh.corners_.push_back(corners_of(mesh, primitive.triangle));
  }
  return bvh;
}

BvhHit Bvh::closest(const Point& p, double bound) const {
  BvhHit best;
  best.squared_distance = bound > 0 ? bound * bound : 0.0;
  walk_near_first(
      nodes_, p, [&] { return best.squared_distance; },
      [&](std::uint32_t i) {
        const NearestOffset nearest = nearest_on_triangle(p, corners_[i]);
        const bool tie = nearest.squared_distance == best.squared_distance && best.triangle != 0xffffffffu;
        if (nearest.squared_distance < best.squared_distance || (tie && order_[i] < best.triangle)) {
          best = {nearest.squared_distance, p + nearest.offset, order_[i]};
        }
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
