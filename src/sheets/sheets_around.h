// Which sheets have points near a place, and how many.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// A k-d tree over the centres of balls. It looks closer only where nodes have points of several sheets, or are large
/// for what is asked: a question takes about as long on any grid.
class SheetsAround {
 public:
  /// `order`: the balls in an order that does not depend on how they came in; answers are then the same to the last
  /// bit.
  SheetsAround(std::span<const Ball> balls, std::span<const std::int32_t> sheet_of, std::vector<std::uint32_t> order);

  /// Has a sheet other than this one a point at a distance below `reach`?
  bool others_near(const Point& at, double reach, std::int32_t sheet) const;

  using Weights = std::vector<std::pair<std::int32_t, double>>;  ///< By sheet, in no order.

  /// Every point at a distance d < reach counts 1 - d / reach. Points of a node that is all of one sheet and no wider
  /// than reach / 4 count as if they were at its centre of mass.
  Weights weights(const Point& at, double reach) const;

 private:
  struct Node {
    Point least, greatest, centroid;
    std::uint32_t first, last;  ///< In order_.
    std::uint32_t right;        ///< The left one comes next; 0: a leaf.
    std::int32_t sheet;         ///< -1: several.
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  void describe(Node& node) const;
  bool others_near(std::uint32_t node, const Point& at, double reach, std::int32_t sheet) const;
  void add(std::uint32_t node, const Point& at, double reach, Weights& out) const;

  std::span<const Ball> balls_;
  std::span<const std::int32_t> sheet_of_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace medial_vk
