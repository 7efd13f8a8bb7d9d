// The hierarchy of boxes and its three walks.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr int kLeafSize = 4;
// Depth is at most log2(2^31) because every split halves; a walk keeps at most one entry per level and side.
constexpr int kStackSize = 128;

// (sqrt(5) - 1) / 86.
constexpr double kShift = 0.61803398874989485 / 43;

double squared_distance_to_box(const Vector3d& p, const Vector3d& lower, const Vector3d& upper) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0).squaredNorm();
}

}  // namespace

Mesh turned_over(Mesh mesh, double room) {
  for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  mesh.unbounded = !mesh.unbounded;
  if (!mesh.closed) mesh.trusted.clear();  // points outside lie on both sides of them
  mesh.room = room;
  return mesh;
}

Tree::Tree(const Mesh& mesh) : far_number_(mesh.unbounded ? 1 : 0) {
  const std::size_t n = mesh.triangles.size();
  corners_.reserve(n);
  std::vector<Vector3d> centroids;
  centroids.reserve(n);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    corners_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    const auto& [a, b, c] = corners_.back();
    const Vector3d cross = (b - a).cross(c - a);
    const double length = cross.norm();
    normals_.push_back(length > 0 ? Vector3d(cross / length) : Vector3d::Zero());
    areas_.push_back(length / 2);
    centroids.emplace_back((a + b + c) / 3);
  }
  order_.resize(n);
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(n);
  build(0, static_cast<int>(n), centroids);
  // The box of the search: that of the mesh, enlarged by the room, if there is one, and then by an irrational share of
  // its longest side at the lower corner, so that no simple plane lies in a face of voxels.
  const double longest = (nodes_[0].upper - nodes_[0].lower).maxCoeff();
  const double shift = mesh.room > 0 ? kShift * longest : 0;
  lower_ = nodes_[0].lower - Vector3d::Constant(mesh.room + shift);
  upper_ = nodes_[0].upper + Vector3d::Constant(mesh.room);
  // A computed nearest point is a corner plus two products, each coordinate off by at most 4u times the largest
  // coordinate or edge (u = 2^-53, edge <= 2 max); subtraction, squares and root add 4u of the distance. In space
  // that is below sqrt(3) * (8u + 8u) * max < 32 u max; the tangential error of the weights counts squared only.
  const double largest = std::max(lower().cwiseAbs().maxCoeff(), upper().cwiseAbs().maxCoeff());
  rounding_ = 32 * 0x1p-53 * largest;
}

int Tree::build(int first, int last, const std::vector<Vector3d>& centroids) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first = first;
  node.last = last;
  node.lower.setConstant(std::numeric_limits<double>::infinity());
  node.upper = -node.lower;
  Vector3d low = node.lower, high = node.upper;
  for (int i = first; i < last; ++i) {
    for (const Vector3d& corner : corners_[order_[i]]) {
      node.lower = node.lower.cwiseMin(corner);
      node.upper = node.upper.cwiseMax(corner);
    }
    low = low.cwiseMin(centroids[order_[i]]);
    high = high.cwiseMax(centroids[order_[i]]);
  }
  add_moments(node);
  if (last - first > kLeafSize) {
    Eigen::Index axis;
    (high - low).maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](int a, int b) { return centroids[a][axis] < centroids[b][axis]; });
    node.left = build(first, middle, centroids);
    node.right = build(middle, last, centroids);
  }
  nodes_[index] = node;
  return index;
}

TrianglePoint Tree::closest_on(int triangle, const Vector3d& p) const {
  const auto& [a, b, c] = corners_[triangle];
  return closest_point_on_triangle(p, a, b, c);
}

Closest Tree::closest(const Vector3d& p) const {
  TrianglePoint best = {p, std::numeric_limits<double>::infinity(), Feature::kFace};
  int triangle = -1;
  // A computed point may leave its box by rounding; boxes are dropped only beyond that, so that all ties are found.
  double limit = best.squared_distance;
  std::array<std::pair<double, int>, kStackSize> stack;
  int size = 0;
  stack[size++] = {squared_distance_to_box(p, lower(), upper()), 0};
  while (size > 0) {
    const auto [bound, index] = stack[--size];
    if (bound > limit) continue;
    const Node& node = nodes_[index];
    if (node.left < 0) {
      for (int i = node.first; i < node.last; ++i) {
        const TrianglePoint here = closest_on(order_[i], p);
        if (here.squared_distance < best.squared_distance ||
            (here.squared_distance == best.squared_distance && order_[i] < triangle)) {
          best = here;
          triangle = order_[i];
          limit = std::pow(std::sqrt(best.squared_distance) + rounding_, 2);
        }
      }
      continue;
    }
    std::pair<double, int> near = {squared_distance_to_box(p, nodes_[node.left].lower, nodes_[node.left].upper),
                                   node.left};
    std::pair<double, int> far = {squared_distance_to_box(p, nodes_[node.right].lower, nodes_[node.right].upper),
                                  node.right};
    if (far.first < near.first) std::swap(near, far);
    if (far.first <= limit) stack[size++] = far;
    if (near.first <= limit) stack[size++] = near;
  }
  return {best.point, std::sqrt(best.squared_distance), triangle, best.feature};
}

bool Tree::ball_is_empty(const Vector3d& centre, double radius) const {
  const double radius2 = radius * radius;
  std::array<int, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (squared_distance_to_box(centre, node.lower, node.upper) >= radius2) continue;
    if (node.left >= 0) {
      stack[size++] = node.left;
      stack[size++] = node.right;
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      if (closest_on(order_[i], centre).squared_distance < radius2) return false;
    }
  }
  return true;
}

std::vector<int> Tree::gather(const Vector3d& centre, double radius) const {
  const double radius2 = radius * radius;
  const double limit = (radius + rounding_) * (radius + rounding_);
  std::vector<int> found;
  std::array<int, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (squared_distance_to_box(centre, node.lower, node.upper) > limit) continue;
    if (node.left >= 0) {
      stack[size++] = node.right;
      stack[size++] = node.left;
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      if (closest_on(order_[i], centre).squared_distance <= radius2) found.push_back(order_[i]);
    }
  }
  return found;
}

Vector3d direction_to(const Vector3d& p, const Closest& nearest) {
  return nearest.distance > 0 ? Vector3d((nearest.point - p) / nearest.distance) : Vector3d::Zero();
}

}  // namespace medial_vk::reference
