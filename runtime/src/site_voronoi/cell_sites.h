// The sites that can be nearest somewhere in a cube: docs/theory.md, "Between sites".
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "site_voronoi/site_forest.h"

namespace medial_vk {

/// A cube.
struct SiteCell {
  Point middle = {0, 0, 0};
  double half = 0;  ///< Of its side.
};

/// A site that may be nearest in a cube, and its nearest point to the middle.
struct CellSite {
  std::uint32_t site = 0;
  SiteHit nearest;
  double distance = 0;
};

/// Which of the sites are on the stack for one cube.
struct CellRange {
  std::size_t begin = 0, end = 0;

  std::size_t count() const { return end - begin; }
};

/// A site at some point.
struct SiteDistance {
  std::uint32_t site = 0;
  double distance = 0;
  Point contact = {0, 0, 0};
  std::uint32_t element = 0;
};

/// A stack of cubes: each is narrowed from one below it, and leaves with all above it.
class CellStack {
 public:
  /// `rounding` bounds the error of a distance within the grid. Keeps a reference to the forest.
  CellStack(const SiteForest& forest, double rounding) : forest_(forest), rounding_(rounding) {}

  /// All sites. Call first.
  CellRange whole();
  /// The sites that are left of those of `outer` in a cube within its cube. One: it is proved to be the nearest to all
  /// points of the cube.
  CellRange narrow(const CellRange& outer, const SiteCell& cell);
  /// Drops all cubes from this one on.
  void drop(const CellRange& range);
  /// The distances of all sites of a cube at a point in it, the nearest first, the first site of equally near ones.
  void measure(const CellRange& range, const Point& p, std::vector<SiteDistance>& distances);
  /// The same from the contacts in the middle, if p is the middle of the cube.
  void recall(const CellRange& range, std::vector<SiteDistance>& distances) const;
  /// The site nearest to the middle.
  std::uint32_t nearest_site(const CellRange& range) const { return sites_[range.begin].site; }

  /// Its distance there.
  double least_distance(const CellRange& range) const { return sites_[range.begin].distance; }

  double rounding() const { return rounding_; }
  std::uint64_t narrowed() const { return narrowed_; }

 private:
  void find_near_sites(const CellRange& outer, const SiteCell& cell);
  void drop_sites_behind(std::size_t begin, const SiteCell& cell);
  bool is_behind(const CellSite& site, const CellSite& front, const SiteCell& cell);

  const SiteForest& forest_;
  double rounding_;
  std::vector<CellSite> sites_;
  std::vector<std::uint32_t> pending_;
  std::uint64_t narrowed_ = 0;
};

}  // namespace medial_vk
