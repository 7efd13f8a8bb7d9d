#include "sphere_fits/quality/nearest_ball_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

void NearestBallTree::rebuild(std::span<const Ball> balls) {
  balls_.assign(balls.begin(), balls.end());
  order_.resize(balls.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.clear();
  nodes_.reserve(balls_.size());
  if (!balls_.empty()) build(0, static_cast<std::uint32_t>(balls_.size()));
}

std::uint32_t NearestBallTree::build(std::uint32_t first, std::uint32_t count) {
  Node node;
  node.first = first;
  node.count = count;
  const Ball& any = balls_[order_[first]];
  node.lower = node.upper = any.centre;
  node.least_radius = node.greatest_radius = any.radius;
  for (std::uint32_t k = first; k < first + count; ++k) {
    const Ball& ball = balls_[order_[k]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.lower[axis] = std::min(node.lower[axis], ball.centre[axis]);
      node.upper[axis] = std::max(node.upper[axis], ball.centre[axis]);
    }
    node.least_radius = std::min(node.least_radius, ball.radius);
    node.greatest_radius = std::max(node.greatest_radius, ball.radius);
  }
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (count <= kLeafSize) return self;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (node.upper[k] - node.lower[k] > node.upper[axis] - node.lower[axis]) axis = k;
  }
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double x = balls_[a].centre[axis], y = balls_[b].centre[axis];
    return x != y ? x < y : a < b;
  });
  build(first, count / 2);
  const std::uint32_t right = build(first + count / 2, count - count / 2);
  nodes_[self].right = right;
  return self;
}

NearestBall NearestBallTree::nearest(const Point& p) const {
  NearestBall best;
  if (nodes_.empty()) return best;
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  const auto bound_of = [&](std::uint32_t node) {
    return distance_to_box(nodes_[node], p) - nodes_[node].greatest_radius;
  };
  std::array<Entry, kStack> stack;
  std::size_t size = 0;
  stack[size++] = {0, bound_of(0)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.bound > best.distance) continue;
    const Node& node = nodes_[entry.node];
    if (node.right != 0) {
      Entry near = {entry.node + 1, bound_of(entry.node + 1)}, far = {node.right, bound_of(node.right)};
      if (far.bound < near.bound) std::swap(near, far);
      if (far.bound <= best.distance) stack[size++] = far;
      if (near.bound <= best.distance) stack[size++] = near;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t i = order_[k];
      const double distance = length(p - balls_[i].centre) - balls_[i].radius;
      if (distance < best.distance || (distance == best.distance && i < best.ball)) best = {distance, i};
    }
  }
  return best;
}

bool NearestBallTree::holds(const Point& p, double depth) const {
  return any_within(p, -depth, [&](std::uint32_t, double distance) { return distance < -depth; });
}

void NearestBallTree::gather(const Point& p, double limit, std::vector<std::uint32_t>& found) const {
  found.clear();
  any_within(p, limit, [&](std::uint32_t ball, double) {
    found.push_back(ball);
    return false;
  });
}

}  // namespace medial_vk
