#include "proximity/node_tree.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "proximity/groups/exchange.h"

namespace medial_vk {
namespace {

constexpr double kUp = 1 + 8 * 0x1p-53;

/// Larger parts stay as they were cut.
constexpr std::size_t kLargestExchanged = BodyNode::kWidth * BodyNode::kWidth;

/// The direction in which positions vary most.
Point widest_direction(std::span<const Point> positions, std::span<const std::uint32_t> chosen) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen) mean += Eigen::Map<const Eigen::Vector3d>(positions[i].data());
  mean /= static_cast<double>(chosen.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d d = Eigen::Map<const Eigen::Vector3d>(positions[i].data()) - mean;
    covariance += d * d.transpose();
  }
  const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
  return {axis.x(), axis.y(), axis.z()};
}

}  // namespace

float rounded_up(double x) {
  x += 8 * 0x1p-53 * std::fabs(x);
  const auto nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

struct NodeTree::Builder {
  using Items = std::span<std::uint32_t>;

  IndexedBalls balls;  // without radii: positions
  std::vector<BodyNode>& nodes;
  std::vector<std::array<Items, BodyNode::kWidth>> items_of;  // by node and slot

  /// Appends `count` parts of `chosen` of nearly equal size to `parts`, by cuts across the widest directions. `chosen`
  /// is reordered; equal positions are ordered by index, so that the parts do not depend on the order before.
  void divide(Items chosen, std::size_t count, std::vector<Items>& parts) const {
    if (count == 1) {
      parts.push_back(chosen);
      return;
    }
    const Point axis = widest_direction(balls.centres, chosen);
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
      const double p = dot(axis, balls.centres[i]), q = dot(axis, balls.centres[j]);
      return p != q ? p < q : i < j;
    };
    const std::size_t first = count / 2, cut = chosen.size() * first / count;
    std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(cut), chosen.end(), before);
    divide(chosen.first(cut), first, parts);
    divide(chosen.subspan(cut), count - first, parts);
  }

  /// Divides the items into as few parts as a tree of so many levels allows, so that few slots are unused.
  /// Precondition: at most 8^levels items.
  std::uint32_t add_node(Items of_node, std::size_t levels) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    items_of.emplace_back();
    const std::size_t most_below = std::size_t{1} << (3 * (levels - 1));  // 8^(levels - 1)
    std::vector<Items> parts;
    divide(of_node, (of_node.size() + most_below - 1) / most_below, parts);
    if (parts.size() > 1 && most_below <= kLargestExchanged && !balls.radii.empty()) exchange(balls, most_below, parts);
    BodyNode node;
    node.radius.fill(kUnusedRadius);
    node.is_lowest = levels == 1;
    for (const Items& part : parts) {
      const std::uint32_t k = node.count++;
      items_of[index][k] = part;
      node.below[k] = node.is_lowest ? part.front() : add_node(part, levels - 1);
    }
    nodes[index] = node;
    return index;
  }
};

NodeTree NodeTree::build(std::span<const Point> positions, const BallAround& ball_around, unsigned threads,
                         std::span<const double> radii, LoopWatch* watch) {
  NodeTree tree;
  if (positions.empty()) return tree;
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  Builder builder{{positions, radii}, tree.nodes_, {}};
  tree.levels_ = node_levels(positions.size());
  builder.add_node(all, tree.levels_);
  constexpr std::size_t kNodesOfBlock = 8;
  parallel_for(tree.nodes_.size(), kNodesOfBlock, threads, [&](std::size_t i) {
    BodyNode& node = tree.nodes_[i];
    for (std::uint32_t k = 0; k < node.count; ++k) {
      if (watch) watch->check();
      const FloatBall ball = ball_around(builder.items_of[i][k]);
      for (std::size_t axis = 0; axis < 3; ++axis) node.centre[axis][k] = ball.centre[axis];
      node.radius[k] = ball.radius;
      node.excess[k] = ball.excess;
    }
    if (watch) watch->finish(1, tree.nodes_.size());
  });
  for (const BodyNode& node : tree.nodes_) {
    for (std::size_t k = 0; k < node.count; ++k) {
      const Point middle = {node.centre[0][k], node.centre[1][k], node.centre[2][k]};
      tree.reach_ = std::max(tree.reach_, (length(middle) + node.radius[k]) * kUp);
    }
  }
  return tree;
}

}  // namespace medial_vk
