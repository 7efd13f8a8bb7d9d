// Power cells, one after the other: which balls cut a cell, found in the hierarchy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "balls/ball_tree.h"
#include "balls/power_cell.h"

namespace medial_vk {

/// For one thread. Neighbours of the ball before are asked first, which makes the cell small before the tree is walked;
/// so cells of balls that follow each other in BallTree::order() cost least.
class CellBuilder {
 public:
  CellBuilder(std::span<const Ball> balls, const BallTree& tree) : balls_(balls), tree_(tree), cell_(balls) {}

  /// The power cell of ball i among all balls, exact where it meets the ball; outside the ball it may be larger.
  /// Until the next call.
  const PowerCell& build(std::uint32_t i);
  /// Forgets the ball before: the rounding of cells then depends only on the calls that follow.
  void forget() { hints_.clear(); }

 private:
  bool may_cut(const BallTree::Node& node, const Point& offset) const;
  void cut_by(std::uint32_t j);
  void read_corners();
  void walk_tree();
  void remember_neighbours();

  std::span<const Ball> balls_;
  const BallTree& tree_;
  PowerCell cell_;
  std::vector<std::uint32_t> hints_;      // balls to ask first
  std::vector<std::uint32_t> asked_for_;  // per ball: the cell, by count, that it was last asked for
  std::uint32_t cells_ = 0;
  std::vector<double> x_, y_, z_, power_;  // of the cell's corners: place, and power of its ball with all slack
  std::vector<std::uint8_t> is_used_;
};

}  // namespace medial_vk
