// Construction of power cells, one after the other; the hierarchy yields the balls that cut a cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/cells/ball_tree.h"
#include "ball_unions/cells/power_cell.h"

namespace medial_vk {

/// For one thread. Neighbours of the previous ball cut first, which makes the cell small before the tree is walked; so
/// cells of balls that follow each other in BallTree::order() cost least.
class CellBuilder {
 public:
  /// With a mask, only its balls count.
  CellBuilder(std::span<const Ball> balls, const BallTree& tree, const BallMask* mask = nullptr)
      : balls_(balls), tree_(tree), mask_(mask), cell_(balls) {}

  /// The power cell of ball i among all balls, exact where it meets the ball; outside the ball it may be larger. Valid
  /// until the next call.
  const PowerCell& build(std::uint32_t i);
  /// The balls whose bisectors bound the cell that was built last, after the ball itself. If that cell is empty: those
  /// of the cell before.
  std::span<const std::uint32_t> neighbours() const { return hints_; }
  /// Forgets the previous ball: the rounding of cells then depends only on later calls.
  void forget() { hints_.clear(); }

 private:
  bool may_cut(const BallTree::Node& node, const Point& offset) const;
  double least_power(const BallTree::Node& node, const Point& offset, std::size_t first) const;
  void cut_by(std::uint32_t j);
  void read_corners();
  void walk_tree();
  void remember_neighbours();

  std::span<const Ball> balls_;
  const BallTree& tree_;
  const BallMask* mask_;
  PowerCell cell_;
  std::vector<std::uint32_t> hints_;       // balls that cut first
  std::vector<double> x_, y_, z_, power_;  // of the cell's corners: position, and power of its ball with all slack
  std::vector<std::uint8_t> is_used_;
};

}  // namespace medial_vk
