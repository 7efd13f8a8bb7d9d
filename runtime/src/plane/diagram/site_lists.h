// The sites that can be nearest in a cell.
#pragma once

#include <span>
#include <vector>

#include "plane/diagram/cell_tree.h"
#include "plane/diagram/needed_sites.h"

namespace medial_vk::plane {

/// Finds them among those of a larger cell, and decides what becomes of the cell. An object is used by one thread.
class SiteLists {
 public:
  SiteLists(const SiteSet& sites, const NeededSites& needed, const DiagramQuery& query);

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

    double bound(Vec2 from_centre) const { return distance + dot(away, from_centre); }
  };
  /// Of the centre to a site; of a segment also where its foot is on the line, and its height over it.
  struct ToCentre {
    double squared, position, height;
  };
  void measure(const Cell& cell);
  void collect(const Cell& cell);
  bool can_be_nearest(const Cell& cell, std::uint32_t site, const ToCentre& at) const;
  bool can_point_be_nearest(const Cell& cell, std::uint32_t point) const;
  bool meets_slab(const Cell& cell, const Segment& segment) const;
  Near bound_of(const Cell& cell, std::uint32_t site, const ToCentre& at) const;
  void prune(const Cell& cell);
  void prune_by_nearest(const Cell& cell);
  void prune_by_corners(const Cell& cell);
  void prune_few(const Cell& cell, std::uint32_t site);
  bool is_dismissed(const Cell& cell) const;
  bool is_wanted_side(const Cell& cell) const;
  bool is_boundary_across() const;
  bool has_small_angles(const Cell& cell) const;
  bool has_one_owner() const;
  bool is_within(const Near& n, double distance) const;
  Vec2 foot_of(const Cell& cell, const Near& n) const { return cell.centre - n.distance * n.away; }
  bool cut_along_passing(const Cell& cell, Line& cut) const;
  bool cut_between_feet(const Cell& cell, Line& cut);
  Line cut_of(const Cell& cell);

  /// The least angle between two directions that are salient together.
  struct Opening {
    double cosine = 1, sine = 0;
    bool is_below_pi = true;
  };
  static Opening opening_of(double object_angle);

  const SiteSet& sites_;
  const NeededSites& needed_;
  const DiagramQuery& query_;
  const double slack_;
  const Opening opening_, deep_opening_;  // below the radius of the query, and from there on
  std::vector<ToCentre> to_centre_;
  std::vector<Near> near_;
  std::vector<Vec2> offsets_;     // of corners from the centre
  std::vector<double> farthest_;  // a site from the corners
  std::vector<double> least_;     // bounds of near sites at the corners, if they are few
  std::vector<double> values_;
  std::vector<std::uint32_t> tried_;  // to prune against
  std::uint32_t nearest_ = 0;         // to the centre
  double nearest_distance_ = 0;
  bool is_wanted_ = true;  // the side of the centre
};

}  // namespace medial_vk::plane
