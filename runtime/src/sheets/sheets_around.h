// Amounts divided among the points around places, and summed by their sheets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// A k-d tree over the centres of balls. What lies close together for what is asked counts as one, so that a question
/// takes about as long on any grid, however many sheets there are.
class SheetsAround {
 public:
  /// `weight_of`: what each ball counts, not negative; those with 0 are as if they were not there. `order`: the balls
  /// in an order that does not depend on how they came in; sums are then the same to the last bit. Sheets are numbered
  /// from 0 up to below `sheets`.
  SheetsAround(std::span<const Ball> balls, std::span<const std::int32_t> sheet_of, std::span<const double> weight_of,
               std::size_t sheets, std::vector<std::uint32_t> order);

  /// Has a sheet other than this one a point at a distance below `reach`?
  bool others_near(const Point& at, double reach, std::int32_t sheet) const;

  /// What points have been given.
  struct Given {
    std::vector<double> sheets;  ///< By sheet.
    std::vector<double> nodes;   ///< By node that has points of several sheets: to its points, for a weight of 1.

    void add(const Given& other);
  };
  Given nothing() const { return {std::vector<double>(sheets_), std::vector<double>(nodes_.size())}; }

  /// Divides an amount among the points at a distance d < reach, in proportion to their weights and 1 - d / reach.
  /// Points of a node count as if they were at its centre of mass if it is no wider than reach / 4 and all of one
  /// sheet, or than reach / 8. If there is no such point, nothing is given, and the answer is false.
  [[nodiscard]] bool divide(double amount, const Point& at, double reach, Given& to) const;

  std::vector<double> by_sheet(const Given& given) const;

 private:
  struct Node {
    Point least, greatest, centroid;
    std::uint32_t first, last;  ///< In order_.
    std::uint32_t right;        ///< The left one comes next; 0: a leaf.
    double weight;              ///< Of all its points.
    std::int32_t sheet;         ///< -1: several.
  };
  /// Points that count alike.
  struct Part {
    double weight;  ///< Of all of them.
    double nearness;
    std::uint32_t node;  ///< Which they are all of, if it has several sheets.
    std::int32_t sheet;  ///< Otherwise.
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  void describe(Node& node) const;
  bool others_near(std::uint32_t index, const Point& at, double reach, std::int32_t sheet) const;
  void find_parts(std::uint32_t index, const Point& at, double reach, std::vector<Part>& parts) const;
  void hand_down(std::uint32_t index, double per_weight, Given& given) const;

  std::span<const Ball> balls_;
  std::span<const std::int32_t> sheet_of_;
  std::span<const double> weight_of_;
  std::size_t sheets_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace medial_vk
