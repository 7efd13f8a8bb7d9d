#include "site_voronoi/site_forest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bvh/nearby_triangles.h"
#include "bvh/triangle_distance.h"

namespace medial_vk {
namespace {

constexpr std::size_t kFewElements = 6;

std::vector<std::array<Point, 3>> elements_of(const VoronoiSite& site) {
  std::vector<std::array<Point, 3>> elements = site.triangles;
  if (site.mesh) {
    const Mesh& mesh = site.mesh->prepared().mesh;
    for (const Triangle& t : mesh.triangles) {
      elements.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
  }
  for (const auto& [a, b] : site.segments) elements.push_back({a, b, b});
  for (const Point& p : site.points) elements.push_back({p, p, p});
  return elements;
}

bool is_usable(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::fabs(x) <= kGreatestSiteCoordinate; });  // false for NaN
}

Result<Bvh> tree_of(const std::vector<std::array<Point, 3>>& elements, unsigned threads) {
  std::vector<Point> corners;
  std::vector<Triangle> triangles;
  corners.reserve(3 * elements.size());
  triangles.reserve(elements.size());
  for (const std::array<Point, 3>& element : elements) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), element.begin(), element.end());
    triangles.push_back({first, first + 1, first + 2});
  }
  BvhOptions how;
  how.threads = threads;
  return Bvh::build({corners, triangles, {}, false}, how);
}

/// Elements with their corners in order, in order: equal for sites of the same elements.
std::vector<std::array<Point, 3>> sorted_elements(const Bvh& tree) {
  std::vector<std::array<Point, 3>> sorted = tree.corners();
  for (std::array<Point, 3>& corners : sorted) {
    std::ranges::sort(corners);
    corners[1] = corners[0] == corners[1] ? corners[2] : corners[1];  // a segment from either end
  }
  std::ranges::sort(sorted);
  return sorted;
}

bool have_equal_boxes(const Bvh& a, const Bvh& b) {
  const BvhBox &x = a.nodes().front().box, &y = b.nodes().front().box;
  return x.lower == y.lower && x.upper == y.upper;
}

Error invalid_site(std::size_t site, const char* problem) {
  return {ErrorCode::kInvalidMesh, fmt::format("site {} {}", site, problem)};
}

bool is_in(const BvhBox& box, const Point& p) { return squared_distance(box, p) == 0; }

}  // namespace

/// Sites of equal boxes are few, so that pairs of neighbours in this order suffice.
Status SiteForest::check_different(const std::vector<Site>& sites) {
  std::vector<std::uint32_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t s) {
    const BvhBox& box = sites[s].tree.nodes().front().box;
    return std::pair(box.lower, box.upper);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Bvh& a = sites[order[i]].tree;
    for (std::size_t k = i + 1; k < order.size() && have_equal_boxes(a, sites[order[k]].tree); ++k) {
      const Bvh& b = sites[order[k]].tree;
      if (a.corners().size() != b.corners().size() || sorted_elements(a) != sorted_elements(b)) continue;
      return Error{ErrorCode::kInvalidMesh, fmt::format("sites {} and {} have the same elements", order[i], order[k])};
    }
  }
  return {};
}

Result<SiteForest::Site> SiteForest::build_site(const VoronoiSite& site, std::size_t number, unsigned threads) {
  Site built;
  built.elements = elements_of(site);
  if (built.elements.empty()) return invalid_site(number, "has no element");
  for (const std::array<Point, 3>& element : built.elements) {
    if (!std::ranges::all_of(element, is_usable)) {
      return invalid_site(number, "has a coordinate that is not finite, or beyond 1e75");
    }
  }
  Result<Bvh> tree = tree_of(built.elements, threads);
  if (!tree) return tree.error();
  built.tree = std::move(tree).value();
  if (built.elements.size() > kFewElements) built.wide.emplace(built.tree);
  if (site.mesh && site.mesh->view().closed) {
    Result<Solid> solid = Solid::build(*site.mesh);
    if (!solid) return solid.error();
    built.solid = std::make_shared<const Solid>(std::move(solid).value());
  }
  return built;
}

Result<SiteForest> SiteForest::build(std::span<const VoronoiSite> sites, unsigned threads) {
  if (sites.size() < 2) return Error{ErrorCode::kInvalidMesh, "there are fewer than two sites"};
  SiteForest forest;
  forest.sites_.reserve(sites.size());
  for (const VoronoiSite& site : sites) {
    Result<Site> built = build_site(site, forest.sites_.size(), threads);
    if (!built) return built.error();
    const BvhBox box = built.value().tree.nodes().front().box;
    const bool is_first = forest.sites_.empty();
    forest.box_ = is_first ? box : BvhBox{least(forest.box_.lower, box.lower), greatest(forest.box_.upper, box.upper)};
    forest.sites_.push_back(std::move(built).value());
  }
  if (Status status = check_different(forest.sites_); !status) return status.error();
  return forest;
}

std::uint32_t SiteForest::solid_around(const Point& p, std::uint32_t first) const {
  for (std::uint32_t s = first; s < sites_.size(); ++s) {
    if (sites_[s].solid && is_in(sites_[s].tree.nodes().front().box, p) && sites_[s].solid->contains(p)) return s;
  }
  return static_cast<std::uint32_t>(sites_.size());
}

SiteHit SiteForest::hit(std::uint32_t site, std::uint32_t element, const Point& p) const {
  const NearestOffset nearest = nearest_on_triangle(p, sites_[site].elements[element]);
  return {nearest.squared_distance, p + nearest.offset, element};
}

SiteHit SiteForest::nearest(std::uint32_t site, const Point& p, const SiteHit& best) const {
  const Site& of = sites_[site];
  if (!of.wide) {
    SiteHit better = best;
    for (std::uint32_t element = 0; element < of.elements.size(); ++element) {
      if (element == best.element || clearly_beyond(p, of.elements[element], better.squared_distance)) continue;
      const SiteHit other = hit(site, element, p);
      if (other.squared_distance < better.squared_distance) better = other;
    }
    return better;
  }
  const BvhHit found = of.wide->closest(of.tree, p, std::sqrt(best.squared_distance));
  if (found.triangle == SiteHit::kNone || !(found.squared_distance < best.squared_distance)) return best;
  return {found.squared_distance, found.point, found.triangle};
}

double SiteForest::distance(const Point& p) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t s = 0; s < sites_.size(); ++s) {
    SiteHit none;
    none.squared_distance = best;
    if (squared_distance(sites_[s].tree.nodes().front().box, p) < best) {
      best = std::min(best, nearest(s, p, none).squared_distance);
    }
  }
  return std::sqrt(best);
}

}  // namespace medial_vk
