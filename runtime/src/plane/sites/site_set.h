// The sites of a Voronoi diagram in the plane: points, and segments without their end points, which are points of the
// set. Where each of them can be nearest is known without the others: a segment within its slab, a point where it lies
// behind the ends of its segments (docs/theory.md, "In the plane").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/sites/vec2.h"

namespace medial_vk::plane {

/// Which side of a segment a point of space lies on.
enum class Side : std::uint8_t { kLeft, kRight };

constexpr Side other(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

struct Segment {
  Vec2 begin;
  Vec2 along;  ///< Unit.
  double length = 0;
  std::array<std::uint32_t, 2> ends = {};
  std::uint32_t owner = 0;

  Vec2 normal(Side side) const { return side == Side::kLeft ? left_of(along) : -left_of(along); }
  /// Positive on that side.
  double height(Vec2 x, Side side) const { return dot(normal(side), x - begin); }
  /// 0 at the begin, `length` at the end.
  double position(Vec2 x) const { return dot(along, x - begin); }
};

/// Points come first, then segments: a site is a number below size().
class SiteSet {
 public:
  using Edge = std::array<std::uint32_t, 2>;
  /// Owners are labels; those of points may be empty, where each point has that of its first segment. Throws
  /// std::bad_alloc. Segments have different ends.
  SiteSet(std::vector<Vec2> points, std::span<const Edge> edges, std::span<const std::uint32_t> owners_of_points,
          std::span<const std::uint32_t> owners_of_edges);

  std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size() + segments_.size()); }
  std::uint32_t points() const { return static_cast<std::uint32_t>(points_.size()); }
  bool is_point(std::uint32_t site) const { return site < points_.size(); }
  Vec2 point(std::uint32_t site) const { return points_[site]; }
  const Segment& segment(std::uint32_t site) const { return segments_[site - points_.size()]; }
  std::uint32_t owner(std::uint32_t site) const {
    return is_point(site) ? owners_of_points_[site] : segment(site).owner;
  }
  /// Whether one is an end of the other.
  bool are_joined(std::uint32_t a, std::uint32_t b) const {
    if (is_point(a) == is_point(b)) return false;
    const auto& ends = segment(std::max(a, b)).ends;
    return ends[0] == std::min(a, b) || ends[1] == std::min(a, b);
  }

  /// From a point of space to a site; a segment counts with its ends.
  double distance_to(std::uint32_t site, Vec2 x) const {
    if (is_point(site)) return plane::distance(points_[site], x);
    const Segment& s = segment(site);
    const Vec2 from = x - s.begin;
    const double position = dot(s.along, from);
    if (position <= 0) return plane::length(from);
    if (position >= s.length) return plane::distance(points_[s.ends[1]], x);
    return std::fabs(cross(s.along, from));
  }
  /// The nearest point of it.
  Vec2 foot(std::uint32_t site, Vec2 x) const;
  /// By how much x lies outside of the region where the site can be nearest, at most 0 within.
  double outside_of_region(std::uint32_t site, Vec2 x) const;
  /// The side of the boundary on which x lies, whose nearest site is `site`, a segment with its ends: of a point, the
  /// segment at the least angle decides. A point without segments has no side, and gives left.
  Side side_of(std::uint32_t site, Vec2 x) const;

  /// Of a point: its segments, by site, in angular order.
  std::span<const std::uint32_t> segments_of(std::uint32_t site) const {
    return std::span(fans_).subspan(first_of_fan_[site], first_of_fan_[site + 1] - first_of_fan_[site]);
  }
  /// From a point along one of its segments, unit.
  Vec2 leaving(std::uint32_t point, std::uint32_t segment_site) const {
    const Segment& s = segment(segment_site);
    return s.ends[0] == point ? s.along : -s.along;
  }

 private:
  void add_segments(std::span<const Edge> edges, std::span<const std::uint32_t> owners);
  void build_fans();

  std::vector<Vec2> points_;
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> owners_of_points_;
  std::vector<std::uint32_t> first_of_fan_, fans_;  // of points
};

}  // namespace medial_vk::plane
