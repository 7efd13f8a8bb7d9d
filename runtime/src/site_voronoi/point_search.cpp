#include "site_voronoi/point_search.h"

#include <algorithm>
#include <cmath>

#include "site_voronoi/equidistant_step.h"

namespace medial_vk {
namespace {

constexpr unsigned kMostSteps = 12;      // of Newton's method, which needs two to four on smooth parts
constexpr unsigned kMostHalvings = 200;  // a secant between doubles needs few
constexpr unsigned kSubdivisions = 6;    // of a voxel
constexpr unsigned kSubdivisionsIfTied = 2;
constexpr double kLeastObjectAngle = 0x1p-13;
constexpr double kLeastRoundings = 0x1p17;  // of the distance: directions are known within the angle above then

double half_angle(const Point& a, const Point& b) {
  const double sine = length(cross(a, b));
  return 0.5 * std::atan2(sine, dot(a, b));
}

SiteCell child_of(const SiteCell& cell, unsigned i) {
  SiteCell child = {cell.middle, 0.5 * cell.half};
  for (std::size_t k = 0; k < 3; ++k) child.middle[k] += ((i >> k) & 1u) != 0 ? child.half : -child.half;
  return child;
}

}  // namespace

Point PointSearch::clamped(const Point& p) const {
  const Point across = {voxel_.half, voxel_.half, voxel_.half};
  return least(greatest(p, voxel_.middle - across), voxel_.middle + across);
}

Point PointSearch::corner(unsigned i) const {
  Point p = voxel_.middle;
  for (std::size_t k = 0; k < 3; ++k) p[k] += ((i >> k) & 1u) != 0 ? voxel_.half : -voxel_.half;
  return p;
}

VoxelOutcome PointSearch::search(const CellRange& sites, const SiteCell& voxel,
                                 const std::array<std::uint32_t, 8>& labels, std::uint32_t most_cells) {
  voxel_ = voxel;
  most_cells_ = most_cells;
  reference_ = voxel.middle;
  rejected_tied_ = rejected_overlapping_ = false;
  overlaps_.clear();
  cells_ = 0;
  stack_.recall(sites, distances_);
  reference_label_ = distances_.front().site;
  // Without a boundary in it, the voxel is on one side of each as a whole.
  has_boundary_ = may_meet_boundary(sites, voxel);
  if (!has_boundary_) {
    const std::uint32_t solid = forest_.solid_around(voxel.middle);
    if (solid < forest_.size()) return inside_of(solid);
  }
  Found found = from_measured(sites, voxel.middle);
  if (found == Found::kNo) found = between_corners(sites, labels);
  if (found == Found::kYes) {
    improve(sites);
    return VoxelOutcome::kPoint;
  }
  VoxelOutcome outcome = subdivide(sites, voxel, 0);
  if (outcome == VoxelOutcome::kPoint) improve(sites);
  // All that is left of the voxel is inside of a solid, or too much is left to tell.
  if (outcome == VoxelOutcome::kEmpty && rejected_overlapping_) return VoxelOutcome::kOverlapping;
  if (outcome == VoxelOutcome::kUndecided && rejected_tied_ && !rejected_overlapping_) return VoxelOutcome::kTied;
  return outcome;
}

/// False only if no point of a boundary is in the cube, whose sites are given.
bool PointSearch::may_meet_boundary(const CellRange& sites, const SiteCell& cell) const {
  return stack_.least_distance(sites) <= std::sqrt(3.0) * cell.half + 4 * stack_.rounding();
}

/// A voxel wholly inside of a solid has no point of the surface. Another solid is around its middle too, or the way to
/// the nearest site does not leave the solid: then both sites overlap.
VoxelOutcome PointSearch::inside_of(std::uint32_t solid) {
  const std::uint32_t second = forest_.solid_around(voxel_.middle, solid + 1);
  const std::uint32_t other = second < forest_.size() ? second : reference_label_;
  if (other == solid) return VoxelOutcome::kEmpty;
  overlaps_.push_back({std::min(solid, other), std::max(solid, other)});
  return VoxelOutcome::kOverlapping;
}

/// Newton's method for the difference of the distances to two elements, within the voxel.
std::optional<Point> PointSearch::between_elements(const SiteDistance& first, const SiteDistance& second,
                                                   const Point& start) const {
  Point p = start;
  for (unsigned step = 0; step < kMostSteps; ++step) {
    const SiteHit a = forest_.hit(first.site, first.element, p), b = forest_.hit(second.site, second.element, p);
    const double to_a = std::sqrt(a.squared_distance), to_b = std::sqrt(b.squared_distance);
    if (std::fabs(to_b - to_a) <= tie() / 4) return p;
    if (!(to_a > 0 && to_b > 0)) return std::nullopt;
    const Point uphill = (1 / to_b) * (p - b.contact) - (1 / to_a) * (p - a.contact);
    const double squared = dot(uphill, uphill);
    if (!(squared > 0)) return std::nullopt;
    const Point next = clamped(p - ((to_b - to_a) / squared) * uphill);
    if (next == p) return std::nullopt;
    p = next;
  }
  return std::nullopt;
}

/// From the last measurement, in `start`: a point at equal distance from the two nearest elements, as long as other
/// elements are nearer there.
PointSearch::Found PointSearch::from_measured(const CellRange& sites, const Point& start) {
  Point p = start;
  for (unsigned step = 0; step < kMostSteps; ++step) {
    const SiteDistance a = distances_[0], b = distances_[1];
    if (b.distance - a.distance <= tie() / 2) return accept(p);
    const std::optional<Point> next = between_elements(a, b, p);
    if (!next || *next == p) return Found::kNo;
    p = *next;
    stack_.measure(sites, p, distances_);
  }
  return Found::kNo;
}

/// The distance to the site of `label`, the nearest to `front`, minus that to all others changes its sign on the way to
/// `behind`, where another site is the nearest.
PointSearch::Found PointSearch::between(const CellRange& sites, const Point& front, std::uint32_t label,
                                        const Point& behind) {
  const auto difference = [&](const Point& p) {
    stack_.measure(sites, p, distances_);
    double own = 0, others = std::numeric_limits<double>::infinity();
    for (const SiteDistance& d : distances_) {
      if (d.site == label) {
        own = d.distance;
      } else {
        others = std::min(others, d.distance);
      }
    }
    return own - others;
  };
  Point low = front, high = behind;
  double at_low = difference(low), at_high = difference(high);
  double share = 0.5;
  for (unsigned step = 0; step < kMostHalvings; ++step) {
    // Secants, and halves after each of them, so that neither end can stay.
    share = step % 2 == 0 && at_high > at_low ? -at_low / (at_high - at_low) : 0.5;
    const Point p = low + std::clamp(share, 0.0, 1.0) * (high - low);
    const double value = difference(p);
    if (std::fabs(value) <= tie() / 2) return accept(p);
    if (p == low && p == high) break;
    Point& end = value < 0 ? low : high;
    if (p == end && step % 2 == 1) break;
    end = p;
    (value < 0 ? at_low : at_high) = value;
  }
  return Found::kNo;
}

/// Of the crossings of lines from the middle to corners, that nearest to the middle.
PointSearch::Found PointSearch::between_corners(const CellRange& sites, const std::array<std::uint32_t, 8>& labels) {
  Found found = Found::kNo;
  std::optional<SitePoint> best;
  const auto from_middle_squared = [&](const Point& p) { return dot(p - voxel_.middle, p - voxel_.middle); };
  for (unsigned i = 0; i < 8; ++i) {
    if (labels[i] == reference_label_) continue;
    const Found here = between(sites, reference_, reference_label_, corner(i));
    found = std::max(found, here);
    if (here != Found::kYes) continue;
    if (!best || from_middle_squared(point_.point) < from_middle_squared(best->point)) best = point_;
  }
  if (best) point_ = *best;
  return found;
}

/// Newton's method from the middle of a smaller cube, if the nearest site is the same there.
PointSearch::Found PointSearch::look_at(const CellRange& child, const SiteCell& cell) {
  if (stack_.nearest_site(child) != reference_label_) return Found::kNo;
  stack_.recall(child, distances_);
  return from_measured(child, cell.middle);
}

/// True only if no point of the cube is outside of all solids. Looked for where solids are known to overlap.
bool PointSearch::is_inside_solid(const CellRange& sites, const SiteCell& cell) const {
  return rejected_overlapping_ && !may_meet_boundary(sites, cell) && forest_.solid_around(cell.middle) < forest_.size();
}

VoxelOutcome PointSearch::subdivide(const CellRange& sites, const SiteCell& cell, unsigned depth) {
  // Where sites share a point, whole voxels are tied. Where a boundary is in the voxel, points outside of solids may be
  // beside rejected ones.
  const bool is_hopeless = rejected_tied_ && !has_boundary_;
  if (depth >= (is_hopeless ? kSubdivisionsIfTied : kSubdivisions) || cells_ >= most_cells_) {
    return VoxelOutcome::kUndecided;
  }
  std::array<CellRange, 8> children;
  std::array<bool, 8> is_open = {};
  std::optional<CellRange> lowest;
  VoxelOutcome outcome = VoxelOutcome::kEmpty;
  for (unsigned i = 0; i < 8 && outcome != VoxelOutcome::kPoint; ++i) {
    ++cells_;
    const SiteCell child = child_of(cell, i);
    children[i] = stack_.narrow(sites, child);
    if (!lowest) lowest = children[i];
    if (is_inside_solid(children[i], child)) continue;
    const std::uint32_t label = stack_.nearest_site(children[i]);
    Found found = Found::kNo;
    if (children[i].count() > 1) {
      is_open[i] = true;
      found = look_at(children[i], child);
    }
    if (found == Found::kNo && label != reference_label_)
      found = between(sites, reference_, reference_label_, child.middle);
    // The way from the middle may cross the surface within a solid, where the cube has a part outside.
    if (found == Found::kRejected && has_boundary_ && is_open[i] && label != reference_label_) {
      stack_.recall(children[i], distances_);
      found = from_measured(children[i], child.middle);
    }
    if (found == Found::kYes) outcome = VoxelOutcome::kPoint;
  }
  for (unsigned i = 0; i < 8 && outcome != VoxelOutcome::kPoint; ++i) {
    if (!is_open[i]) continue;
    const VoxelOutcome below = subdivide(children[i], child_of(cell, i), depth + 1);
    if (below != VoxelOutcome::kEmpty) outcome = below;
  }
  stack_.drop(*lowest);
  return outcome;
}

/// The sites at equal distance among the last measurement, at least so many.
bool PointSearch::fill(const Point& p, std::uint32_t least_count, SitePoint& point) const {
  const double nearest = distances_.front().distance;
  std::vector<SiteDistance> equal;
  for (const SiteDistance& d : distances_) {
    if (d.distance - nearest <= tie() && equal.size() < point.sites.size()) equal.push_back(d);
  }
  if (equal.size() < least_count) return false;
  point = {};
  point.point = p;
  point.distance = nearest;
  point.error = equal.back().distance - nearest + 2 * stack_.rounding();
  point.count = static_cast<std::uint32_t>(equal.size());
  std::ranges::sort(equal, {}, &SiteDistance::site);
  for (std::size_t i = 0; i < equal.size(); ++i) {
    point.sites[i] = equal[i].site;
    point.contacts[i] = equal[i].contact;
    for (std::size_t k = 0; k < i; ++k) {
      point.object_angle = std::max(point.object_angle, half_angle(equal[i].contact - p, equal[k].contact - p));
    }
  }
  return true;
}

/// After a measurement in p.
PointSearch::Found PointSearch::accept(const Point& p) {
  SitePoint point;
  if (!fill(p, 2, point)) return Found::kNo;
  if (!(point.distance > kLeastRoundings * stack_.rounding()) || !(point.object_angle >= kLeastObjectAngle)) {
    rejected_tied_ = true;
    return Found::kRejected;
  }
  // A voxel without a boundary is outside.
  const std::uint32_t solid = has_boundary_ ? forest_.solid_around(p) : static_cast<std::uint32_t>(forest_.size());
  if (solid < forest_.size()) {
    rejected_overlapping_ = true;
    const std::uint32_t second = forest_.solid_around(p, solid + 1);
    const std::uint32_t other = second < forest_.size()   ? second
                                : point.sites[0] != solid ? point.sites[0]
                                                          : point.sites[1];
    overlaps_.push_back({std::min(solid, other), std::max(solid, other)});
    return Found::kRejected;
  }
  point_ = point;
  return Found::kYes;
}

/// Moves the point to where more sites are equally near, if such a point is near it in the voxel.
void PointSearch::improve(const CellRange& sites) {
  if (sites.count() < 3) return;
  for (std::uint32_t count = point_.count + 1; count <= 4; ++count) {
    const std::optional<SitePoint> meeting = meeting_near(sites, count);
    if (!meeting) return;
    point_ = *meeting;
  }
}

/// Newton's method for the differences of the distances to the nearest `count` sites.
std::optional<SitePoint> PointSearch::meeting_near(const CellRange& sites, std::uint32_t count) {
  if (sites.count() < count) return std::nullopt;
  const SitePoint before = point_;
  Point p = point_.point;
  for (unsigned step = 0; step < kMostSteps; ++step) {
    stack_.measure(sites, p, distances_);
    if (distances_[count - 1].distance - distances_[0].distance <= tie() / 2) break;
    if (!(distances_[0].distance > 0)) return std::nullopt;
    const std::optional<Point> way = step_to_equal(p, std::span(distances_).first(count));
    if (!way) return std::nullopt;
    p = p + *way;
    const Point off = p - voxel_.middle;
    const double most = 2 * voxel_.half;
    if (std::fabs(off[0]) > most || std::fabs(off[1]) > most || std::fabs(off[2]) > most) return std::nullopt;
  }
  if (clamped(p) != p || distances_[count - 1].distance - distances_[0].distance > tie() / 2) return std::nullopt;
  const bool was_tied = rejected_tied_, was_overlapping = rejected_overlapping_;
  const bool is_fine = accept(p) == Found::kYes && point_.count >= count;
  rejected_tied_ = was_tied;
  rejected_overlapping_ = was_overlapping;
  if (is_fine) return point_;
  point_ = before;
  return std::nullopt;
}

}  // namespace medial_vk
