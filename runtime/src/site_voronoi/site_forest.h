// The elements of all sites: a tree for each site. Segments and points are triangles with equal corners, which the
// distance of a triangle allows.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "bvh/wide_tree.h"
#include "medial_vk/bvh.h"
#include "medial_vk/site_voronoi.h"
#include "solid/solid.h"

namespace medial_vk {

/// Fourth powers of distances stay finite, of which areas are roots.
constexpr double kGreatestSiteCoordinate = 1e75;

/// The nearest point of one site, and its element.
struct SiteHit {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  double squared_distance = std::numeric_limits<double>::infinity();
  Point contact = {0, 0, 0};
  std::uint32_t element = kNone;
};

/// Queries may come from several threads at once.
class SiteForest {
 public:
  /// Errors: those of find_site_voronoi() about sites. Throws std::bad_alloc.
  static Result<SiteForest> build(std::span<const VoronoiSite> sites, unsigned threads);

  std::size_t size() const { return sites_.size(); }
  const Bvh& tree(std::uint32_t site) const { return sites_[site].tree; }
  const BvhBox& box() const { return box_; }
  /// The first solid from number `first` on that holds p; size() if none does.
  std::uint32_t solid_around(const Point& p, std::uint32_t first = 0) const;
  /// To an element of a site.
  SiteHit hit(std::uint32_t site, std::uint32_t element, const Point& p) const;
  /// The nearest point of a site if it is nearer than `best`, which is of that site or none; else `best`.
  SiteHit nearest(std::uint32_t site, const Point& p, const SiteHit& best) const;
  /// The distance to the nearest site.
  double distance(const Point& p) const;

 private:
  struct Site {
    std::vector<std::array<Point, 3>> elements;
    Bvh tree;
    std::optional<WideTree> wide;        // none: there are few elements
    std::shared_ptr<const Solid> solid;  // null: no solid
  };

  static Result<Site> build_site(const VoronoiSite& site, std::size_t number, unsigned threads);
  static Status check_different(const std::vector<Site>& sites);

  std::vector<Site> sites_;
  BvhBox box_ = {};
};

}  // namespace medial_vk
