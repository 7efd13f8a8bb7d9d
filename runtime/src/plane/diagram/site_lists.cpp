#include "plane/diagram/site_lists.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "plane/diagram/direction_cone.h"

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

SiteLists::SiteLists(const SiteSet& sites, const NeededSites& needed, const DiagramQuery& query)
    : sites_(sites),
      needed_(needed),
      query_(query),
      slack_(kRounding + query.slack),
      opening_(opening_of(query.least_angle(0))),
      deep_opening_(opening_of(query.least_angle(std::numeric_limits<double>::infinity()))) {}

SiteLists::Opening SiteLists::opening_of(double object_angle) {
  const double angle = 2 * object_angle - kLeastAngle / 2;
  return {std::cos(angle), std::sin(angle), angle < std::numbers::pi};
}

void SiteLists::measure(const Cell& cell) {
  offsets_.clear();
  for (const Vec2 corner : cell.corners) offsets_.push_back(corner - cell.centre);
  to_centre_.resize(cell.sites.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cell.sites.size(); ++i) {
    const std::uint32_t site = cell.sites[i];
    ToCentre& at = to_centre_[i];
    if (sites_.is_point(site)) {
      const Vec2 from = cell.centre - sites_.point(site);
      at.squared = dot(from, from);
    } else {
      const Segment& s = sites_.segment(site);
      const Vec2 from = cell.centre - s.begin;
      at.position = dot(s.along, from);
      at.height = cross(s.along, from);
      const double beyond = std::max({-at.position, at.position - s.length, 0.0});
      at.squared = beyond * beyond + at.height * at.height;
    }
    if (at.squared >= least) continue;
    least = at.squared;
    nearest_ = site;
  }
  nearest_distance_ = std::sqrt(least);
}

bool SiteLists::meets_slab(const Cell& cell, const Segment& segment) const {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Vec2 corner : cell.corners) {
    const double position = segment.position(corner);
    least = std::min(least, position);
    most = std::max(most, position);
  }
  return most > -slack_ && least < segment.length + slack_;
}

bool SiteLists::can_point_be_nearest(const Cell& cell, std::uint32_t point) const {
  const Vec2 p = sites_.point(point);
  return std::ranges::all_of(sites_.segments_of(point), [&](std::uint32_t s) {
    const Vec2 way = sites_.leaving(point, s);
    const double at_centre = dot(way, cell.centre - p);
    if (at_centre <= 0) return true;
    if (at_centre > cell.reach + slack_) return false;
    return std::ranges::any_of(cell.corners, [&](Vec2 corner) { return dot(way, corner - p) < slack_; });
  });
}

/// Most sites are decided by the centre and the reach, the others by the corners.
bool SiteLists::can_be_nearest(const Cell& cell, std::uint32_t site, const ToCentre& at) const {
  if (sites_.is_point(site)) return can_point_be_nearest(cell, site);
  const Segment& s = sites_.segment(site);
  const double beyond = std::max(-at.position, at.position - s.length);
  if (beyond <= 0 || (beyond <= cell.reach + slack_ && meets_slab(cell, s))) return true;
  const unsigned stands_for = needed_.stands_for[site - sites_.points()];
  return ((stands_for & 1) != 0 && can_point_be_nearest(cell, s.ends[0])) ||
         ((stands_for & 2) != 0 && can_point_be_nearest(cell, s.ends[1]));
}

SiteLists::Near SiteLists::bound_of(const Cell& cell, std::uint32_t site, const ToCentre& at) const {
  const double distance = std::sqrt(at.squared);
  Vec2 foot;
  if (sites_.is_point(site)) {
    foot = sites_.point(site);
  } else {
    const Segment& s = sites_.segment(site);
    const Side side = at.height > 0 ? Side::kLeft : Side::kRight;
    const double above = std::fabs(at.height);
    const auto is_beside = [&](Vec2 corner) { return s.height(corner, side) >= -slack_; };
    if (above > cell.reach + slack_ || std::ranges::all_of(cell.corners, is_beside)) {
      return {site, above, s.normal(side), true};
    }
    foot = s.begin + std::clamp(at.position, 0.0, s.length) * s.along;
  }
  // A distance is convex, so it is at least its linear part.
  if (!(distance > 0)) return {site, 0, {}, false};
  return {site, distance, (1 / distance) * (cell.centre - foot), false};
}

void SiteLists::collect(const Cell& cell) {
  near_.clear();
  // A site that is nearest anywhere in the cell is at most twice the reach farther from the centre than the nearest.
  const double most = nearest_distance_ + 2 * cell.reach + slack_, squared = most * most;
  for (std::size_t i = 0; i < cell.sites.size(); ++i) {
    const ToCentre& at = to_centre_[i];
    if (at.squared > squared || !can_be_nearest(cell, cell.sites[i], at)) continue;
    near_.push_back(bound_of(cell, cell.sites[i], at));
  }
}

/// Removes sites that are farther than the one nearest to the centre in all of the cell. The linear lower bound of a
/// distance less the distance from that site is concave, so that its least value is at a corner.
void SiteLists::prune_by_nearest(const Cell& cell) {
  farthest_.clear();
  for (const Vec2 corner : cell.corners) farthest_.push_back(sites_.distance_to(nearest_, corner));
  std::erase_if(near_, [&](const Near& n) {
    if (n.site == nearest_) return false;
    for (std::size_t i = 0; i < farthest_.size(); ++i) {
      if (n.bound(offsets_[i]) - farthest_[i] <= slack_) return false;
    }
    return true;
  });
}

/// The same by another site; bounds at the corners are known.
void SiteLists::prune_few(const Cell& cell, std::uint32_t site) {
  const std::size_t corners = cell.corners.size();
  farthest_.clear();
  for (const Vec2 corner : cell.corners) farthest_.push_back(sites_.distance_to(site, corner));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const double* row = least_.data() + i * corners;
    bool is_farther = near_[i].site != site;
    for (std::size_t k = 0; k < corners && is_farther; ++k) is_farther = row[k] - farthest_[k] > slack_;
    if (is_farther) continue;
    if (kept != i) {
      near_[kept] = near_[i];
      std::copy_n(row, corners, least_.data() + kept * corners);
    }
    ++kept;
  }
  near_.resize(kept);
}

/// By the sites that are nearest to the corners.
void SiteLists::prune_by_corners(const Cell& cell) {
  const std::size_t corners = cell.corners.size();
  least_.resize(near_.size() * corners);
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t k = 0; k < corners; ++k) {
      least_[i * corners + k] = near_[i].bound(offsets_[k]);
    }
  }
  tried_.assign(1, nearest_);
  for (std::size_t k = 0; k < corners && near_.size() > 3; ++k) {
    double least = sites_.distance_to(nearest_, cell.corners[k]);
    std::uint32_t best = nearest_;
    for (std::size_t i = 0; i < near_.size(); ++i) {
      if (least_[i * corners + k] >= least) continue;
      const double d = sites_.distance_to(near_[i].site, cell.corners[k]);
      if (d >= least) continue;
      least = d;
      best = near_[i].site;
    }
    if (std::ranges::find(tried_, best) != tried_.end()) continue;
    tried_.push_back(best);
    prune_few(cell, best);
  }
}

void SiteLists::prune(const Cell& cell) {
  if (near_.size() < 2) return;
  prune_by_nearest(cell);
  if (near_.size() <= kManySites) prune_by_corners(cell);
}

bool SiteLists::is_wanted_side(const Cell& cell) const {
  return query_.wanted == Wanted::kBetweenOwners || query_.wanted == Wanted::kBothSides ||
         allows(query_.wanted, sites_.side_of(nearest_, cell.centre));
}

/// Whether the site can be so near to a point of the cell.
bool SiteLists::is_within(const Near& n, double distance) const {
  return std::ranges::any_of(offsets_, [&](Vec2 offset) { return n.bound(offset) <= distance; });
}

/// Whether the boundary may meet the cell. If not, the side of the centre is that of the whole cell.
bool SiteLists::is_boundary_across() const {
  return std::ranges::any_of(near_, [&](const Near& n) { return !n.is_linear && is_within(n, slack_); });
}

/// Whether the directions to any two sites, from any point of the cell, differ by less than twice the threshold.
bool SiteLists::has_small_angles(const Cell& cell) const {
  // The boundary may cross the cell, which lies on both sides of such a segment.
  const auto is_crossing = [&](const Near& n) { return !n.is_linear && !sites_.is_point(n.site); };
  if (std::ranges::any_of(near_, is_crossing)) return false;
  Opening opening = opening_;
  if (std::isfinite(query_.radius)) {
    double farthest = 0;  // of the boundary from a point of the cell
    for (const Vec2 corner : cell.corners) farthest = std::max(farthest, sites_.distance_to(nearest_, corner));
    if (farthest + slack_ >= query_.radius) opening = deep_opening_;
  }
  DirectionCone cone(opening.cosine, opening.sine);
  for (const Near& n : near_) {
    if (n.is_linear) {
      if (opening.is_below_pi && !cone.add(n.away)) return false;
      continue;
    }
    if (is_within(n, slack_)) return false;
    if (!opening.is_below_pi) continue;
    for (const Vec2 corner : cell.corners) {
      if (!cone.add(corner - sites_.point(n.site))) return false;
    }
  }
  return true;
}

bool SiteLists::has_one_owner() const {
  const std::uint32_t owner = sites_.owner(near_.front().site);
  return std::ranges::all_of(near_, [&](const Near& n) { return sites_.owner(n.site) == owner; });
}

bool SiteLists::is_dismissed(const Cell& cell) const {
  if (near_.size() < 2 || (!is_wanted_ && !is_boundary_across()) || has_small_angles(cell)) return true;
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
  const double spread = length({xx - yy, 2 * xy});                  // of the variances along both axes, the difference
  if (!(3 * spread > xx + yy)) return false;                        // one is less than twice the other
  const double cosine = std::clamp((xx - yy) / spread, -1.0, 1.0);  // of twice the turn of the longer axis
  const Vec2 way = {std::sqrt((1 + cosine) / 2), std::copysign(std::sqrt((1 - cosine) / 2), xy)};
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
  is_wanted_ = is_wanted_side(cell);
  if (nearest_distance_ > cell.reach + slack_ && !is_wanted_) return CellState::kDismissed;
  collect(cell);
  prune(cell);
  if (is_dismissed(cell)) return CellState::kDismissed;
  for (const Near& n : near_) list.push_back(n.site);
  if (near_.size() <= CellTree::kLeafSites) return CellState::kLeaf;
  cut = cut_of(cell);
  return CellState::kDivided;
}

}  // namespace medial_vk::plane
