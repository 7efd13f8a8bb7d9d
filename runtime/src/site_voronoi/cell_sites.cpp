#include "site_voronoi/cell_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bvh/nearby_triangles.h"
#include "bvh/triangle_distance.h"

namespace medial_vk {
namespace {

/// Half the diagonal of a cube.
double reach_of(const SiteCell& cell) { return std::sqrt(3.0) * cell.half; }

double sum_of_sizes(const Point& v) { return std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]); }

/// The vector from p to the nearest point of a box.
Point offset_to(const BvhBox& box, const Point& p) { return least(greatest(p, box.lower), box.upper) - p; }

void sort_by_distance(std::vector<SiteDistance>& distances) {
  std::ranges::sort(distances, [](const SiteDistance& a, const SiteDistance& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.site < b.site;
  });
}

/// The tangent of the distance to the front site in the middle of a cube, from above, and what a convex set behind it
/// must exceed.
struct FrontTangent {
  Point middle;
  double half;
  double distance;
  Point gradient;
  double lipschitz;  ///< A set that is this far from the middle is behind.
  double excess;     ///< The curvature of the distance to a point, and the rounding.

  /// True only if a convex set with its nearest point to the middle at this offset is farther from every point of the
  /// cube than the front site.
  bool is_before(const Point& offset) const {
    const double d = length(offset);
    if (d > lipschitz) return true;
    if (!(d > 0)) return false;
    const Point turn = (-1 / d) * offset - gradient;
    return d - distance - half * sum_of_sizes(turn) > excess;
  }
};

}  // namespace

CellRange CellStack::whole() {
  sites_.clear();
  for (std::uint32_t s = 0; s < forest_.size(); ++s) sites_.push_back({s, {}, 0});
  return {0, sites_.size()};
}

void CellStack::drop(const CellRange& range) { sites_.resize(std::min(sites_.size(), range.begin)); }

/// Appends the sites within D + 2 h of the middle, where D is the least distance there, the nearest of them first.
void CellStack::find_near_sites(const CellRange& outer, const SiteCell& cell) {
  const std::size_t begin = sites_.size();
  const double slack = 2 * reach_of(cell) + 4 * rounding_;
  double least_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = outer.begin; i < outer.end; ++i) {
    CellSite site = sites_[i];
    SiteHit best;
    if (site.nearest.element != SiteHit::kNone) best = forest_.hit(site.site, site.nearest.element, cell.middle);
    const double most = (least_distance + slack) * (least_distance + slack);
    if (best.squared_distance > most) best = {most, {}, SiteHit::kNone};
    best = forest_.nearest(site.site, cell.middle, best);
    if (best.element == SiteHit::kNone) continue;
    site.nearest = best;
    site.distance = std::sqrt(best.squared_distance);
    least_distance = std::min(least_distance, site.distance);
    sites_.push_back(site);
  }
  std::size_t kept = begin;
  for (std::size_t i = begin; i < sites_.size(); ++i) {
    if (sites_[i].distance <= least_distance + slack) sites_[kept++] = sites_[i];
  }
  sites_.resize(kept);
  const auto first = sites_.begin() + static_cast<std::ptrdiff_t>(begin);
  std::iter_swap(first, std::min_element(first, sites_.end(),
                                         [](const CellSite& a, const CellSite& b) { return a.distance < b.distance; }));
}

/// True only if each point of the cube is nearer to `front` than to `site`.
///
/// The distance to the contact of `front` is at most d + g.x + |x|^2 / (2 d) at the middle plus x, and that to a convex
/// set at least d' + g'.x. The contact of a thin triangle may be wrong by sqrt(2 d' r) along it, r the error of its
/// distance, and the direction to it by sqrt(2 r / d').
bool CellStack::is_behind(const CellSite& site, const CellSite& front, const SiteCell& cell) {
  const double d = front.distance, s = cell.half;
  if (!(d > 8 * rounding_)) return false;
  FrontTangent tangent = {cell.middle, s, d, (1 / d) * (cell.middle - front.nearest.contact), 0, 0};
  tangent.lipschitz = d + 2 * reach_of(cell) + 4 * rounding_;
  tangent.excess = 1.5 * s * s / d + 4 * rounding_ + 4 * s * std::sqrt(rounding_ / d);
  const Bvh& tree = forest_.tree(site.site);
  if (!tangent.is_before(site.nearest.contact - cell.middle)) return false;
  pending_.assign(1, 0);
  while (!pending_.empty()) {
    const BvhNode& node = tree.nodes()[pending_.back()];
    pending_.pop_back();
    if (tangent.is_before(offset_to(node.box, cell.middle))) continue;
    if (node.count == 0) {
      pending_.push_back(node.first);
      pending_.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (!tangent.is_before(nearest_on_triangle(cell.middle, tree.corners()[k]).offset)) return false;
    }
  }
  return true;
}

void CellStack::drop_sites_behind(std::size_t begin, const SiteCell& cell) {
  std::size_t kept = begin + 1;
  for (std::size_t i = begin + 1; i < sites_.size(); ++i) {
    if (!is_behind(sites_[i], sites_[begin], cell)) sites_[kept++] = sites_[i];
  }
  sites_.resize(kept);
}

CellRange CellStack::narrow(const CellRange& outer, const SiteCell& cell) {
  ++narrowed_;
  const std::size_t begin = sites_.size();
  find_near_sites(outer, cell);
  drop_sites_behind(begin, cell);
  return {begin, sites_.size()};
}

void CellStack::measure(const CellRange& range, const Point& p, std::vector<SiteDistance>& distances) {
  distances.clear();
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const CellSite& site = sites_[i];
    const SiteHit best = forest_.nearest(site.site, p, forest_.hit(site.site, site.nearest.element, p));
    distances.push_back({site.site, std::sqrt(best.squared_distance), best.contact, best.element});
  }
  sort_by_distance(distances);
}

void CellStack::recall(const CellRange& range, std::vector<SiteDistance>& distances) const {
  distances.clear();
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const CellSite& site = sites_[i];
    distances.push_back({site.site, site.distance, site.nearest.contact, site.nearest.element});
  }
  sort_by_distance(distances);
}

}  // namespace medial_vk
