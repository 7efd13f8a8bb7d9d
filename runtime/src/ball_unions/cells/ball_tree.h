// A hierarchy of balls, to find those that may cut a power cell.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A complete binary tree over balls, halved along the longest principal axis of their centres. Balls along a sheet lie
/// near a plane, and their radii change linearly to first order: a node is a box along the principal axes, thin across
/// the sheet, with a linear bound of powers. Boxes along the coordinate axes, with the largest radius in each, exclude
/// several times fewer balls (docs/decisions.md).
class BallTree {
 public:
  struct Node {
    Point middle;
    std::array<Point, 3> axes;  ///< Orthonormal up to rounding.
    Point half;                 ///< Half extents of the box of the centres, along the axes.
    Point slope;                ///< With `least`: |c - middle|^2 - r^2 >= least + slope . (c - middle) for its balls,
    double least;               ///< slope and c - middle along the axes.
    double size;                ///< The greatest distance from `middle` that its balls reach.
    double radius;              ///< The largest; below 0 in an empty node.
  };
  static constexpr std::uint32_t kLeaf = 4;

  /// Balls as scaled_balls() makes them: coordinates and radii up to 1.
  BallTree(std::span<const Ball> balls, unsigned threads);

  /// The balls, leaf by leaf: most neighbours in space are neighbours in this order.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Node 0 is the root; children of k: 2 k + 1 and 2 k + 2.
  const Node& node(std::uint32_t k) const { return nodes_[k]; }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  std::uint32_t first_leaf() const { return leaves_ - 1; }
  bool is_leaf(std::uint32_t k) const { return k + 1 >= leaves_; }
  std::span<const std::uint32_t> balls_of_leaf(std::uint32_t k) const;

 private:
  void build(std::uint32_t k, std::size_t begin, std::size_t span);
  std::size_t end_of(std::size_t begin, std::size_t span) const;

  std::span<const Ball> balls_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::uint32_t leaves_ = 1;
};

/// The balls of a tree that are included, and the nodes that have any.
class BallMask {
 public:
  /// Includes all balls.
  explicit BallMask(const BallTree& tree);

  bool holds(std::uint32_t ball) const { return is_in_[ball] != 0; }
  bool any_in(std::uint32_t node) const { return count_[node] > 0; }
  void set(std::uint32_t ball, bool in);

 private:
  std::vector<std::uint8_t> is_in_;
  std::vector<std::uint32_t> leaf_of_;  // by ball
  std::vector<std::uint32_t> count_;    // by node
};

}  // namespace medial_vk
