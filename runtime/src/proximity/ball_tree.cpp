#include "proximity/ball_tree.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

// Of a quantity that is computed in double with fewer than eight roundings.
constexpr double kUp = 1 + 8 * 0x1p-53;

float rounded_up(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

Point point_of(const FloatBall& ball) { return {ball.centre[0], ball.centre[1], ball.centre[2]}; }

FloatBall at(const Point& centre) {
  return {{static_cast<float>(centre[0]), static_cast<float>(centre[1]), static_cast<float>(centre[2])}, 0};
}

/// The direction in which centres vary most.
Point widest_direction(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen) mean += Eigen::Map<const Eigen::Vector3d>(balls[i].centre.data());
  mean /= static_cast<double>(chosen.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d d = Eigen::Map<const Eigen::Vector3d>(balls[i].centre.data()) - mean;
    covariance += d * d.transpose();
  }
  const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
  return {axis.x(), axis.y(), axis.z()};
}

/// Reorders `chosen` so that its first half lies before its second along the widest direction; equal positions are
/// ordered by index, so the result does not depend on the order before.
void halve(std::span<const Ball> balls, std::span<std::uint32_t> chosen) {
  const Point axis = widest_direction(balls, chosen);
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const double p = dot(axis, balls[i].centre), q = dot(axis, balls[j].centre);
    return p != q ? p < q : i < j;
  };
  std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(chosen.size() / 2), chosen.end(),
                   before);
}

/// A point near the centre of the smallest ball around the chosen balls (M. Badoiu and K. Clarkson, "Smaller core-sets
/// for balls", 2003): step i goes the share 1/(i + 1) of the way to the farthest point.
Point middle_of(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  Point middle = balls[chosen.front()].centre;
  const std::size_t steps = chosen.size() <= 4096 ? 128 : 32;
  for (std::size_t i = 1; i <= steps; ++i) {
    double farthest = -1;
    Point there = middle;
    for (const std::uint32_t k : chosen) {
      const Point away = balls[k].centre - middle;
      const double distance = length(away), reach = distance + balls[k].radius;
      if (reach <= farthest) continue;
      farthest = reach;
      there = distance > 0 ? middle + (reach / distance) * away : middle;
    }
    middle = middle + (1.0 / static_cast<double>(i + 1)) * (there - middle);
  }
  return middle;
}

}  // namespace

BallTree BallTree::build(std::span<const Ball> balls, const Point& centre) {
  BallTree tree;
  tree.centre_ = centre;
  if (balls.empty()) return tree;
  tree.leaves_.reserve(balls.size());
  for (const Ball& ball : balls) {
    const Point relative = ball.centre - centre;
    FloatBall leaf = at(relative);
    leaf.radius = rounded_up((ball.radius + length(relative - point_of(leaf)) + 0x1p-52 * length(relative)) * kUp);
    tree.leaves_.push_back(leaf);
  }
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  tree.root_ball_ = tree.ball_around(balls, all);
  tree.build_node(balls, all);
  const auto reach_of = [](const FloatBall& ball) { return (length(point_of(ball)) + ball.radius) * kUp; };
  tree.reach_ = reach_of(tree.root_ball_);
  for (const BallNode& node : tree.nodes_) {
    for (std::size_t k = 0; k < BallNode::kWidth; ++k) tree.reach_ = std::max(tree.reach_, reach_of(node.ball(k)));
  }
  return tree;
}

/// Eight parts by halving three times; each has at most an eighth of the balls, rounded up.
std::uint32_t BallTree::build_node(std::span<const Ball> balls, std::span<std::uint32_t> of_node) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  std::vector<std::span<std::uint32_t>> parts = {of_node};
  if (of_node.size() > BallNode::kWidth) {
    for (int round = 0; round < 3; ++round) {
      std::vector<std::span<std::uint32_t>> halves;
      for (const std::span<std::uint32_t> part : parts) {
        halve(balls, part);
        halves.push_back(part.first(part.size() / 2));
        halves.push_back(part.subspan(part.size() / 2));
      }
      parts = std::move(halves);
    }
  } else {
    parts.clear();
    for (std::size_t k = 0; k < of_node.size(); ++k) parts.push_back(of_node.subspan(k, 1));
  }
  for (std::size_t k = 0; k < BallNode::kWidth; ++k) {
    FloatBall ball = {{0, 0, 0}, -3e38f};
    std::uint32_t below = 0;
    if (k < parts.size() && !parts[k].empty()) {
      const bool is_leaf = parts[k].size() == 1;
      ball = is_leaf ? leaves_[parts[k].front()] : ball_around(balls, parts[k]);
      below = is_leaf ? kLeaf | parts[k].front() : build_node(balls, parts[k]);
    }
    BallNode& node = nodes_[index];  // build_node() may have moved it
    for (std::size_t axis = 0; axis < 3; ++axis) node.centre[axis][k] = ball.centre[axis];
    node.radius[k] = ball.radius;
    node.below[k] = below;
  }
  return index;
}

/// Holds all leaves of a node, as they are in float.
FloatBall BallTree::ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> of_node) const {
  FloatBall ball = at(middle_of(balls, of_node) - centre_);
  const Point middle = point_of(ball);
  double radius = 0;
  for (const std::uint32_t i : of_node) {
    radius = std::max(radius, length(point_of(leaves_[i]) - middle) + leaves_[i].radius);
  }
  ball.radius = rounded_up(radius * kUp);
  return ball;
}

}  // namespace medial_vk
