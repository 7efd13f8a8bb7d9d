#include "plane/diagram/site_lists.h"

#include <algorithm>
#include <array>
#include <limits>

namespace medial_vk::plane {
namespace {

// Of distances in this file, from coordinates within [-1/2, 1/2] and some ten operations.
constexpr double kRounding = 0x1p-49;
constexpr std::size_t kManySites = 12;  // more, and comparisons at corners remove too few

/// The extent of a cell in a direction.
double extent(const Cell& cell, Vec2 way) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Vec2 corner : cell.corners) {
    least = std::min(least, dot(way, corner));
    most = std::max(most, dot(way, corner));
  }
  return most - least;
}

/// Through the centre, across the longest extent, so that cells do not become thin.
Line cut_across(const Cell& cell) {
  Vec2 longest_side;
  for (std::size_t i = 0; i < cell.corners.size(); ++i) {
    const Vec2 side = cell.corners[(i + 1) % cell.corners.size()] - cell.corners[i];
    if (dot(side, side) > dot(longest_side, longest_side)) longest_side = side;
  }
  Vec2 best;
  double most = -1;
  const Vec2 along = unit(longest_side);
  for (const Vec2 way : {Vec2{1, 0}, Vec2{0, 1}, along, left_of(along)}) {
    const double size = extent(cell, way);
    if (size <= most * (1 + 0x1p-20)) continue;
    most = size;
    best = way;
  }
  return {best, dot(best, cell.centre)};
}

}  // namespace

SiteLists::SiteLists(const SiteSet& sites, const DiagramQuery& query)
    : sites_(sites), query_(query), slack_(kRounding + query.slack) {}

bool SiteLists::can_be_nearest(const Cell& cell, std::uint32_t site) const {
  if (!sites_.is_point(site)) {
    const Segment& s = sites_.segment(site);
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vec2 corner : cell.corners) {
      const double position = s.position(corner);
      least = std::min(least, position);
      most = std::max(most, position);
    }
    return most > -slack_ && least < s.length + slack_;
  }
  return std::ranges::all_of(sites_.segments_of(site), [&](std::uint32_t s) {
    const Vec2 way = sites_.leaving(site, s);
    return std::ranges::any_of(cell.corners,
                               [&](Vec2 corner) { return dot(way, corner - sites_.point(site)) < slack_; });
  });
}

SiteLists::Near SiteLists::bound_of(const Cell& cell, std::uint32_t site, double distance) const {
  if (!sites_.is_point(site)) {
    const Segment& s = sites_.segment(site);
    const double height = s.height(cell.centre, Side::kLeft);
    const Side side = height > 0 ? Side::kLeft : Side::kRight;
    const auto is_beside = [&](Vec2 corner) { return s.height(corner, side) >= -slack_; };
    if (std::ranges::all_of(cell.corners, is_beside)) return {site, std::fabs(height), s.normal(side), true};
  }
  // A distance is convex, so it is at least its linear part.
  if (!(distance > 0)) return {site, 0, {}, false};
  return {site, distance, (1 / distance) * (cell.centre - sites_.foot(site, cell.centre)), false};
}

void SiteLists::measure(const Cell& cell) {
  distances_.clear();
  nearest_distance_ = std::numeric_limits<double>::infinity();
  for (const std::uint32_t site : cell.sites) {
    distances_.push_back(sites_.distance_to(site, cell.centre));
    if (distances_.back() >= nearest_distance_) continue;
    nearest_distance_ = distances_.back();
    nearest_ = site;
  }
}

void SiteLists::collect(const Cell& cell) {
  near_.clear();
  // A site that is nearest anywhere in the cell is at most twice the reach farther from the centre than the nearest.
  const double most = nearest_distance_ + 2 * cell.reach + slack_;
  for (std::size_t i = 0; i < cell.sites.size(); ++i) {
    const std::uint32_t site = cell.sites[i];
    if (distances_[i] > most || !can_be_nearest(cell, site)) continue;
    near_.push_back(bound_of(cell, site, distances_[i]));
  }
}

/// Removes sites that are farther than one site in all of the cell. The linear lower bound of a distance less the
/// distance from that site is concave, so that its least value is at a corner.
void SiteLists::prune_against(const Cell& cell, std::uint32_t site) {
  farthest_.clear();
  for (const Vec2 corner : cell.corners) farthest_.push_back(sites_.distance_to(site, corner));
  std::erase_if(near_, [&](const Near& n) {
    if (n.site == site) return false;
    for (std::size_t i = 0; i < farthest_.size(); ++i) {
      if (n.distance + dot(n.away, cell.corners[i] - cell.centre) - farthest_[i] <= slack_) return false;
    }
    return true;
  });
}

void SiteLists::prune(const Cell& cell) {
  if (near_.size() < 2) return;
  tried_.assign(1, nearest_);
  prune_against(cell, nearest_);
  if (near_.size() > kManySites) return;
  for (const Vec2 corner : cell.corners) {
    if (near_.size() <= 3) return;
    double least = sites_.distance_to(nearest_, corner);
    std::uint32_t best = nearest_;
    for (const Near& n : near_) {
      if (n.distance + dot(n.away, corner - cell.centre) >= least) continue;
      const double d = sites_.distance_to(n.site, corner);
      if (d >= least) continue;
      least = d;
      best = n.site;
    }
    if (std::ranges::find(tried_, best) != tried_.end()) continue;
    tried_.push_back(best);
    prune_against(cell, best);
  }
}

bool SiteLists::is_wanted_side(const Cell& cell) const {
  return query_.wanted == Wanted::kBetweenOwners || query_.wanted == Wanted::kBothSides ||
         allows(query_.wanted, sites_.side_of(nearest_, cell.centre));
}

bool SiteLists::is_on_other_side(const Cell& cell) const {
  if (is_wanted_side(cell)) return false;
  // The side is that of the whole cell unless the boundary crosses it.
  return std::ranges::none_of(near_, [&](const Near& n) {
    return !n.is_linear && std::ranges::any_of(cell.corners, [&](Vec2 corner) {
      return n.distance + dot(n.away, corner - cell.centre) <= slack_;
    });
  });
}

/// Whether the directions to any two sites, from any point of the cell, differ by less than twice the threshold.
bool SiteLists::has_small_angles(const Cell& cell) const {
  const Vec2 middle = near_.front().away;
  double least = 0, greatest = 0;
  const auto add = [&](Vec2 away) {
    const double turn = std::atan2(cross(middle, away), dot(middle, away));
    least = std::min(least, turn);
    greatest = std::max(greatest, turn);
  };
  double farthest = 0;  // of the boundary from a point of the cell
  for (const Vec2 corner : cell.corners) farthest = std::max(farthest, sites_.distance_to(nearest_, corner));
  const double most = 2 * query_.least_angle(farthest + slack_) - kLeastAngle / 2;
  for (const Near& n : near_) {
    if (n.is_linear) {
      add(n.away);
    } else {
      if (!sites_.is_point(n.site)) return false;  // the boundary may cross the cell, which lies on both sides of it
      const auto is_beyond = [&](Vec2 corner) { return n.distance + dot(n.away, corner - cell.centre) > slack_; };
      if (!std::ranges::all_of(cell.corners, is_beyond)) return false;
      for (const Vec2 corner : cell.corners) add(corner - sites_.point(n.site));
    }
    if (greatest - least >= most) return false;
  }
  return true;
}

bool SiteLists::has_one_owner() const {
  const std::uint32_t owner = sites_.owner(near_.front().site);
  return std::ranges::all_of(near_, [&](const Near& n) { return sites_.owner(n.site) == owner; });
}

bool SiteLists::is_dismissed(const Cell& cell) const {
  if (near_.size() < 2 || is_on_other_side(cell) || has_small_angles(cell)) return true;
  return query_.wanted == Wanted::kBetweenOwners && has_one_owner();
}

/// Where segments pass through the cell side by side, the cut follows the one next to the centre: between two of them
/// few sites are nearest, however long the cell is.
bool SiteLists::cut_along_passing(const Cell& cell, Line& cut) const {
  std::size_t passing = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Near& n : near_) {
    if (n.is_linear || sites_.is_point(n.site)) continue;
    const Segment& s = sites_.segment(n.site);
    const auto is_within = [&](Vec2 corner) {
      const double position = s.position(corner);
      return position > 0 && position < s.length;
    };
    if (!std::ranges::all_of(cell.corners, is_within)) continue;
    ++passing;
    const double height = std::fabs(s.height(cell.centre, Side::kLeft));
    if (height >= least) continue;
    least = height;
    cut = {s.normal(Side::kLeft), dot(s.normal(Side::kLeft), s.begin)};
  }
  return passing >= 2 && 4 * passing >= near_.size();
}

/// Where the nearest points of the sites lie along a line, the cut divides them in two halves.
bool SiteLists::cut_between_feet(const Cell& cell, Line& cut) {
  const double count = static_cast<double>(near_.size());
  Vec2 mean;
  for (const Near& n : near_) mean = mean + (1 / count) * foot_of(cell, n);
  double xx = 0, xy = 0, yy = 0;
  for (const Near& n : near_) {
    const Vec2 from = foot_of(cell, n) - mean;
    xx += from.x * from.x;
    xy += from.x * from.y;
    yy += from.y * from.y;
  }
  const double spread = std::hypot(xx - yy, 2 * xy);  // of the variances along both axes, the difference
  if (!(3 * spread > xx + yy)) return false;          // one is less than twice the other
  const double turn = std::atan2(2 * xy, xx - yy) / 2;
  const Vec2 way = {std::cos(turn), std::sin(turn)};
  const double quarter = extent(cell, way) / 4, middle = dot(way, cell.centre);
  values_.clear();
  for (const Near& n : near_) values_.push_back(dot(way, foot_of(cell, n)));
  const auto median = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
  std::ranges::nth_element(values_, median);
  cut = {way, std::clamp(*median, middle - quarter, middle + quarter)};
  return true;
}

/// Cuts that suit the sites are made as long as they leave fewer: three quarters at most. Cuts across the longest
/// extent in between make every cell small in the end.
Line SiteLists::cut_of(const Cell& cell) {
  Line cut;
  if (cut_along_passing(cell, cut)) return cut;
  if (4 * near_.size() <= 3 * cell.sites.size() && cut_between_feet(cell, cut)) return cut;
  return cut_across(cell);
}

CellState SiteLists::find(const Cell& cell, std::vector<std::uint32_t>& list, Line& cut) {
  measure(cell);
  if (nearest_distance_ > cell.reach + slack_ && !is_wanted_side(cell)) return CellState::kDismissed;
  collect(cell);
  prune(cell);
  if (is_dismissed(cell)) return CellState::kDismissed;
  for (const Near& n : near_) list.push_back(n.site);
  if (near_.size() <= CellTree::kLeafSites) return CellState::kLeaf;
  cut = cut_of(cell);
  return CellState::kDivided;
}

}  // namespace medial_vk::plane
