// Points of the surface in one voxel, from the sites that may be nearest there.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "site_voronoi/cell_sites.h"

namespace medial_vk {

/// Why a point at equal distance from two sites is none of the surface.
enum class Rejection : std::uint8_t { kNone, kTied, kOverlapping };

/// What the search in a voxel ended with.
enum class VoxelOutcome : std::uint8_t { kEmpty, kPoint, kUndecided, kTied, kOverlapping };

/// Searches one voxel at a time.
class PointSearch {
 public:
  PointSearch(const SiteForest& forest, CellStack& stack) : forest_(forest), stack_(stack) {}

  /// `sites` are those of the voxel, two or more; `labels` the nearest sites to its corners, corner i at the upper end
  /// of axis k if bit k of i is set. The voxel is divided no more once `most_cells` cells are examined.
  VoxelOutcome search(const CellRange& sites, const SiteCell& voxel, const std::array<std::uint32_t, 8>& labels,
                      std::uint32_t most_cells);
  /// Of the last search, those of the voxel's divisions.
  std::uint32_t cells() const { return cells_; }
  /// After kPoint.
  const SitePoint& point() const { return point_; }
  /// After kOverlapping, or beside any outcome: pairs of solids or of a solid and another site.
  const std::vector<std::array<std::uint32_t, 2>>& overlaps() const { return overlaps_; }

 private:
  enum class Found : std::uint8_t { kNo, kRejected, kYes };

  std::optional<Point> between_elements(const SiteDistance& first, const SiteDistance& second,
                                        const Point& start) const;
  Found from_measured(const CellRange& sites, const Point& start);
  Found between(const CellRange& sites, const Point& front, std::uint32_t label, const Point& behind);
  Found between_corners(const CellRange& sites, const std::array<std::uint32_t, 8>& labels);
  VoxelOutcome subdivide(const CellRange& sites, const SiteCell& cell, unsigned depth);
  bool may_meet_boundary(const CellRange& sites, const SiteCell& cell) const;
  bool is_inside_solid(const CellRange& sites, const SiteCell& cell) const;
  VoxelOutcome inside_of(std::uint32_t solid);
  Found look_at(const CellRange& child, const SiteCell& cell);
  Found accept(const Point& p);
  void improve(const CellRange& sites);
  std::optional<SitePoint> meeting_near(const CellRange& sites, std::uint32_t count);
  bool fill(const Point& p, std::uint32_t least_count, SitePoint& point) const;
  Point clamped(const Point& p) const;
  Point corner(unsigned i) const;
  /// Distances that differ by no more are equal.
  double tie() const { return 8 * stack_.rounding(); }

  const SiteForest& forest_;
  CellStack& stack_;
  SiteCell voxel_;
  SitePoint point_;
  std::vector<SiteDistance> distances_;  // of the last measurement
  std::vector<std::array<std::uint32_t, 2>> overlaps_;
  Point reference_ = {0, 0, 0};  // the middle of the voxel, and the nearest site there
  std::uint32_t reference_label_ = 0;
  bool has_boundary_ = false;  // perhaps, in the voxel
  bool rejected_tied_ = false, rejected_overlapping_ = false;
  std::uint32_t cells_ = 0, most_cells_ = 0;
};

}  // namespace medial_vk
