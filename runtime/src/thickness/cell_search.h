// Directions from a point, divided into ever smaller cells (docs/theory.md, "Thickness").
#pragma once

#include <cstdint>
#include <vector>

#include "thickness/balls_near.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// Closes cells in which no ball is larger than the target, and divides others.
class CellSearch {
 public:
  explicit CellSearch(BallsNear& balls) : balls_(balls) {}

  void start();
  /// No centre in the directions of this cell is farther from p than the reach.
  void add(const DirectionCell& cell, double reach) { push({cell, reach}); }
  /// Until all cells are closed, or no further distances may be computed. Returns the greatest reach of a cell that is
  /// left open, or 0.
  double run();

 private:
  /// Directions in which there may be larger balls than the target.
  struct Open {
    DirectionCell cell;
    double reach;                  // no centre of a ball is farther from p
    ContactLists::List list = {};  // contacts that may bound balls in a part of the cell
    std::uint32_t number = 0;      // for one order of equals
  };

  /// A contact shows up to this distance from p that no ball is larger than the target.
  struct Turn {
    std::uint32_t contact;
    double end;
  };

  void divide();
  void push(Open open);
  double reach_along_middle(const Open& open);
  void evaluate(Open& open);
  void evaluate_again(Open& open);
  bool is_closed(const Open& open);
  bool is_on_other_side(const Open& open) const;
  double shown_in(const Open& open);
  double shown_along_middle(const Open& open);
  void show_along(Open& open);
  void mix_along(Open& open);

  BallsNear& balls_;
  std::vector<Open> open_;  // a heap by reach
  NearIntervals intervals_;
  std::vector<Turn> turns_;
  std::uint32_t number_ = 0;
  double left_ = 0;  // the greatest reach of cells that cannot be divided
};

}  // namespace medial_vk
