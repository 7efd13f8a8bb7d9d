// Amounts divided among the points around a location, and summed by sheets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// A k-d tree over the centres of balls. Points that lie close together in comparison with the reach of a query count
/// as one, so that the time of a query hardly depends on the resolution of the grid or the number of sheets.
class SheetsAround {
 public:
  /// `weight_of`: the weight of each ball, not negative; balls of weight 0 are ignored. `order`: the balls in an order
  /// that does not depend on the input order; sums are then the same to the last bit. Sheets have numbers from 0 to
  /// `sheets` - 1.
  SheetsAround(std::span<const Ball> balls, std::span<const std::int32_t> sheet_of, std::span<const double> weight_of,
               std::size_t sheets, std::vector<std::uint32_t> order);

  /// True if a sheet other than this one has a point at a distance below `reach`.
  bool others_near(const Point& at, double reach, std::int32_t sheet) const;

  /// The amounts that points have received.
  struct Given {
    std::vector<double> sheets;  ///< By sheet.
    /// By node with points of several sheets: the amount for its points, per unit of weight.
    std::vector<double> nodes;

    void add(const Given& other);
  };
  Given nothing() const { return {std::vector<double>(sheets_), std::vector<double>(nodes_.size())}; }

  /// Divides an amount among the points at a distance d < reach, in proportion to their weights and 1 - d / reach.
  /// Points of a node count as if they were at its centre of mass if it is no wider than reach / 4 and all of one
  /// sheet, or than reach / 8. If there is no such point, returns false and leaves `to` unchanged.
  [[nodiscard]] bool divide(double amount, const Point& at, double reach, Given& to) const;

  std::vector<double> by_sheet(const Given& given) const;

 private:
  struct Node {
    Point least, greatest, centroid;
    std::uint32_t first, last;  ///< In order_.
    std::uint32_t right;        ///< The right child; the left one comes next; 0: a leaf.
    double weight;              ///< Of all its points.
    std::int32_t sheet;         ///< -1: several.
  };
  /// Points with a common distance.
  struct Part {
    double weight;  ///< Of all of them.
    double nearness;
    std::uint32_t node;  ///< The node of the points, if it has several sheets.
    std::int32_t sheet;  ///< The sheet of the points otherwise.
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  void describe(Node& node) const;
  bool others_near(std::uint32_t index, const Point& at, double reach, std::int32_t sheet) const;
  void find_parts(std::uint32_t index, const Point& at, double reach, std::vector<Part>& parts) const;
  void distribute(std::uint32_t index, double per_weight, Given& given) const;

  std::span<const Ball> balls_;
  std::span<const std::int32_t> sheet_of_;
  std::span<const double> weight_of_;
  std::size_t sheets_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace medial_vk
