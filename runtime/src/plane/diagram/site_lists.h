// The sites that can be nearest in a cell.
#pragma once

#include <span>
#include <vector>

#include "plane/diagram/cell_tree.h"

namespace medial_vk::plane {

/// Finds them among those of a larger cell, and decides what becomes of the cell. An object is used by one thread.
class SiteLists {
 public:
  SiteLists(const SiteSet& sites, const DiagramQuery& query);

  /// `cell` has the sites of the larger cell. Appends its own to `list` unless it is dismissed. Sets `cut`, the line by
  /// which a divided cell is to be divided.
  CellState find(const Cell& cell, std::vector<std::uint32_t>& list, Line& cut);

 private:
  /// In the part of the cell where the site can be nearest, its distance from x is at least
  /// `distance` + `away` (x - centre).
  struct Near {
    std::uint32_t site;
    double distance;
    Vec2 away;
    bool is_linear;  // equality: the line of a segment, all of the cell on one side of it
  };
  void measure(const Cell& cell);
  void collect(const Cell& cell);
  bool can_be_nearest(const Cell& cell, std::uint32_t site) const;
  Near bound_of(const Cell& cell, std::uint32_t site, double distance) const;
  void prune(const Cell& cell);
  void prune_against(const Cell& cell, std::uint32_t site);
  bool is_dismissed(const Cell& cell) const;
  bool is_wanted_side(const Cell& cell) const;
  bool is_on_other_side(const Cell& cell) const;
  bool has_small_angles(const Cell& cell) const;
  bool has_one_owner() const;
  Vec2 foot_of(const Cell& cell, const Near& n) const { return cell.centre - n.distance * n.away; }
  bool cut_along_passing(const Cell& cell, Line& cut) const;
  bool cut_between_feet(const Cell& cell, Line& cut);
  Line cut_of(const Cell& cell);

  const SiteSet& sites_;
  const DiagramQuery& query_;
  const double slack_;
  std::vector<Near> near_;
  std::vector<double> distances_, farthest_, values_;
  std::vector<std::uint32_t> tried_;  // to prune against
  std::uint32_t nearest_ = 0;         // to the centre
  double nearest_distance_ = 0;
};

}  // namespace medial_vk::plane
