// Distances from points to a union of balls, by a tree over the balls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// The ball nearest to a point, or in which the point is deepest.
struct NearestBall {
  double distance = std::numeric_limits<double>::infinity();  ///< |p - c| - r: negative inside.
  std::uint32_t ball = 0xffffffffu;                           ///< The smallest index among equals.
};

/// The point of a ball's sphere that is nearest to p; the ball's centre has none.
inline Point point_of_sphere(const Ball& ball, const Point& p) {
  const Point to = p - ball.centre;
  const double distance = length(to);
  return distance > 0 ? ball.centre + (ball.radius / distance) * to : ball.centre;
}

/// Evaluates f(p) = min |p - c_i| - r_i: the distance to the union outside of it, 0 on its envelope, negative inside. f
/// has Lipschitz constant 1. Queries may come from several threads at once.
class NearestBallTree {
 public:
  struct Node {
    Point lower, upper;  ///< Of the centres.
    double least_radius, greatest_radius;
    std::uint32_t first = 0, count = 0;  ///< Positions in order().
    std::uint32_t right = 0;             ///< Second child; the first follows its parent. 0: a leaf.
  };

  /// Copies the balls, at least one.
  explicit NearestBallTree(std::span<const Ball> balls) { rebuild(balls); }
  /// The same in the memory that it has.
  void rebuild(std::span<const Ball> balls);

  NearestBall nearest(const Point& p) const;
  /// True if the point is in one of the balls by more than `depth`. Stops at the first.
  bool holds(const Point& p, double depth = 0) const;
  /// Indices of the balls with |p - c| - r <= limit, in arbitrary order, replace `found`.
  void gather(const Point& p, double limit, std::vector<std::uint32_t>& found) const;

  /// Calls visit(ball, |p - c| - r) where the latter is at most `limit`, until a call returns true; returns whether one
  /// did.
  template <class Visit>
  bool any_within(const Point& p, double limit, const Visit& visit) const;

  const std::vector<Ball>& balls() const { return balls_; }  ///< In input order.
  const std::vector<Node>& nodes() const { return nodes_; }  ///< Root first.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  // Ranges are halved: 2^31 balls are 31 levels.
  static constexpr std::size_t kStack = 64;
  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  std::vector<Ball> balls_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Of the box that a node's centres lie in.
inline double distance_to_box(const NearestBallTree::Node& node, const Point& p) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double out = std::max({node.lower[axis] - p[axis], p[axis] - node.upper[axis], 0.0});
    sum += out * out;
  }
  return std::sqrt(sum);
}

inline double farthest_in_box(const NearestBallTree::Node& node, const Point& p) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double out = std::max(std::fabs(p[axis] - node.lower[axis]), std::fabs(p[axis] - node.upper[axis]));
    sum += out * out;
  }
  return std::sqrt(sum);
}

template <class Visit>
bool NearestBallTree::any_within(const Point& p, double limit, const Visit& visit) const {
  if (nodes_.empty()) return false;
  std::array<std::uint32_t, kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (distance_to_box(node, p) - node.greatest_radius > limit) continue;
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = at + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const Ball& ball = balls_[order_[k]];
      const double distance = length(p - ball.centre) - ball.radius;
      if (distance <= limit && visit(order_[k], distance)) return true;
    }
  }
  return false;
}

}  // namespace medial_vk
