#include "proximity/body_tree.h"

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

/// Appends `count` parts of `chosen` of nearly equal size to `parts`, by cuts across the widest directions. `chosen` is
/// reordered; equal positions are ordered by index, so that the parts do not depend on the order before.
void divide(std::span<const Ball> balls, std::span<std::uint32_t> chosen, std::size_t count,
            std::vector<std::span<std::uint32_t>>& parts) {
  if (count == 1) {
    parts.push_back(chosen);
    return;
  }
  const Point axis = widest_direction(balls, chosen);
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const double p = dot(axis, balls[i].centre), q = dot(axis, balls[j].centre);
    return p != q ? p < q : i < j;
  };
  const std::size_t first = count / 2, cut = chosen.size() * first / count;
  std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(cut), chosen.end(), before);
  divide(balls, chosen.first(cut), first, parts);
  divide(balls, chosen.subspan(cut), count - first, parts);
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

BodyTree BodyTree::build(std::span<const Ball> balls, const Point& centre) {
  BodyTree tree;
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
  tree.build_node(balls, all, body_tree_levels(balls.size()));
  for (const BodyNode& node : tree.nodes_) {
    for (std::size_t k = 0; k < node.count; ++k) {
      const Point middle = {node.centre[0][k], node.centre[1][k], node.centre[2][k]};
      tree.reach_ = std::max(tree.reach_, (length(middle) + node.radius[k]) * kUp);
    }
  }
  return tree;
}

/// Divides the balls into as few parts as a tree of so many levels allows, so that few slots are unused. Precondition:
/// at most 8^levels balls.
std::uint32_t BodyTree::build_node(std::span<const Ball> balls, std::span<std::uint32_t> of_node, std::size_t levels) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const std::size_t most_below = std::size_t{1} << (3 * (levels - 1));  // 8^(levels - 1)
  std::vector<std::span<std::uint32_t>> parts;
  divide(balls, of_node, (of_node.size() + most_below - 1) / most_below, parts);
  BodyNode node;
  node.radius.fill(-3e38f);
  node.is_lowest = levels == 1;
  for (const std::span<std::uint32_t> part : parts) {
    const std::uint32_t k = node.count++;
    const FloatBall ball = node.is_lowest ? leaves_[part.front()] : ball_around(balls, part);
    for (std::size_t axis = 0; axis < 3; ++axis) node.centre[axis][k] = ball.centre[axis];
    node.radius[k] = ball.radius;
    node.below[k] = node.is_lowest ? part.front() : build_node(balls, part, levels - 1);
  }
  nodes_[index] = node;
  return index;
}

/// Holds all leaves of a node, as they are in float. Of equal leaves it is the leaf: a larger ball would be closer to
/// other balls than any of them, so that no search could pass over it.
FloatBall BodyTree::ball_around(std::span<const Ball> balls, std::span<const std::uint32_t> of_node) const {
  const FloatBall& first = leaves_[of_node.front()];
  if (std::ranges::all_of(of_node, [&](std::uint32_t i) { return leaves_[i] == first; })) return first;
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
