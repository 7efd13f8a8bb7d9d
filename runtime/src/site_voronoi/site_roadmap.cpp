#include "medial_vk/site_roadmap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/voxel_order.h"
#include "site_voronoi/grid_rounding.h"
#include "site_voronoi/line_clearance.h"

namespace medial_vk {

struct SiteRoadmap::Impl {
  SiteForest forest;
  double rounding = 0;
  std::vector<ClearPlace> places;  // by point
  std::vector<RoadmapLink> links;
  std::vector<std::uint32_t> component_of_point;
  std::uint32_t components = 0;
};

namespace {

using Voxel = std::array<std::uint32_t, 3>;

constexpr std::size_t kPointsOfABlock = 256;
constexpr std::size_t kJoinsOfAPlace = 128;                      // that are tested
constexpr std::array<double, 4> kStepsFromAnEnd = {1, 2, 4, 8};  // of its clearance

std::uint32_t point_in(const std::vector<SitePoint>& points, const Voxel& voxel) {
  const auto at = std::lower_bound(points.begin(), points.end(), voxel,
                                   [](const SitePoint& p, const Voxel& v) { return is_earlier_voxel(p.voxel, v); });
  const bool is_there = at != points.end() && at->voxel == voxel;
  return is_there ? static_cast<std::uint32_t>(at - points.begin()) : SitePath::kNoPoint;
}

/// The points in those of the 26 voxels around one that come after it, ascending.
std::vector<std::uint32_t> later_neighbours(const std::vector<SitePoint>& points, std::uint32_t of) {
  std::vector<std::uint32_t> neighbours;
  const Voxel& voxel = points[of].voxel;
  for (unsigned i = 14; i < 27; ++i) {  // in base 3, the offsets plus one, z first: 13 is no offset
    const std::array<unsigned, 3> digits = {i % 3, i / 3 % 3, i / 9};
    Voxel other = voxel;
    bool is_in_grid = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_in_grid = is_in_grid && other[k] + digits[k] >= 1;
      other[k] += digits[k] - 1;
    }
    if (!is_in_grid) continue;
    const std::uint32_t neighbour = point_in(points, other);
    if (neighbour != SitePath::kNoPoint) neighbours.push_back(neighbour);
  }
  return neighbours;
}

std::vector<RoadmapLink> find_links(const SiteForest& forest, double rounding, const std::vector<ClearPlace>& places,
                                    const std::vector<SitePoint>& points, unsigned threads, LoopWatch& watch) {
  const std::size_t blocks = (points.size() + kPointsOfABlock - 1) / kPointsOfABlock;
  std::vector<std::vector<RoadmapLink>> links(blocks);
  parallel_for(blocks, 1, threads, [&](std::size_t block) {
    watch.check();
    const auto begin = static_cast<std::uint32_t>(block * kPointsOfABlock);
    const auto end = static_cast<std::uint32_t>(std::min(points.size(), (block + 1) * kPointsOfABlock));
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const std::uint32_t k : later_neighbours(points, i)) {
        const double width = clearance_of_line(forest, rounding, places[i], places[k]);
        if (width > 0) links[block].push_back({{i, k}, length(places[k].at - places[i].at), width});
      }
    }
    watch.finish(1, blocks);
  });
  std::vector<RoadmapLink> all;
  for (const std::vector<RoadmapLink>& of_block : links) all.insert(all.end(), of_block.begin(), of_block.end());
  return all;
}

/// Of places that are numbered: those of the graph, then both ends.
struct Join {
  std::uint32_t from = 0, to = 0;
  double width = 0;
};

/// A place that is none of the graph, with the error of distances around it: beyond the grid they are larger, in
/// proportion.
struct OuterPlace {
  ClearPlace place;
  double rounding = 0;
};

/// With clearance 0 inside of a solid.
OuterPlace outer_place(const SiteForest& forest, double rounding, const Point& at) {
  OuterPlace outer = {{at, 0}, std::max(rounding, 0x1p-47 * greatest_coordinate({at, at}))};
  if (forest.solid_around(at) == forest.size()) outer.place.clearance = forest.distance(at) - outer.rounding;
  return outer;
}

/// Both ends of a path.
Status take_ends(const SiteForest& forest, double rounding, const std::array<Point, 2>& ends,
                 std::vector<OuterPlace>& outer) {
  for (const Point& end : ends) {
    const char* const name = &end == ends.data() ? "`from`" : "`to`";
    if (!std::ranges::all_of(end, [](double x) { return std::fabs(x) <= kGreatestSiteCoordinate; })) {
      return Error{ErrorCode::kUsage, std::string(name) + " must be a finite point, with no coordinate beyond 1e75"};
    }
    outer.push_back(outer_place(forest, rounding, end));
    if (!(outer.back().place.clearance > 0)) {
      return Error{ErrorCode::kUsage, std::string(name) + " must be outside of all sites"};
    }
  }
  return {};
}

/// Places on the ray from the nearest contact through an end of a path, which lead away from the site that may hide
/// the graph from it.
void add_places_behind(const SiteForest& forest, double rounding, const ClearPlace& end,
                       std::vector<OuterPlace>& outer) {
  SiteHit best;
  for (std::uint32_t s = 0; s < forest.size(); ++s) {
    SiteHit limit;
    limit.squared_distance = best.squared_distance;
    const SiteHit hit = forest.nearest(s, end.at, limit);
    if (hit.squared_distance < best.squared_distance) best = hit;
  }
  for (const double steps : kStepsFromAnEnd) {
    const OuterPlace place = outer_place(forest, rounding, end.at + steps * (end.at - best.contact));
    if (place.place.clearance > 0) outer.push_back(place);
  }
}

/// Of a place to the graph: to points that are near, or likely to be seen from it through wide gaps.
void join_place(const SiteForest& forest, const std::vector<ClearPlace>& places, const OuterPlace& outer,
                std::size_t most, std::uint32_t number, std::vector<Join>& joins) {
  const ClearPlace& place = outer.place;
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  const std::size_t tested = std::min(places.size(), most);
  const auto way = [&](std::uint32_t i) { return length(places[i].at - place.at); };
  std::vector<std::uint32_t> chosen;
  const auto choose = [&](const auto& before) {
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(tested);
    std::partial_sort(order.begin(), middle, order.end(), before);
    chosen.insert(chosen.end(), order.begin(), middle);
  };
  choose([&](std::uint32_t a, std::uint32_t b) { return std::pair(way(a), a) < std::pair(way(b), b); });
  choose([&](std::uint32_t a, std::uint32_t b) {
    return std::pair(way(a) - places[a].clearance, a) < std::pair(way(b) - places[b].clearance, b);
  });
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (const std::uint32_t i : chosen) {
    const double width = clearance_of_line(forest, outer.rounding, place, places[i]);
    if (width > 0) joins.push_back({number, i, width});
  }
}

/// Of places that are none of the graph, to it and to each other.
void join_outer_places(const SiteForest& forest, const std::vector<ClearPlace>& places,
                       const std::vector<OuterPlace>& outer, std::vector<Join>& joins) {
  const auto count = static_cast<std::uint32_t>(places.size());
  for (std::uint32_t i = 0; i < outer.size(); ++i) {
    join_place(forest, places, outer[i], kJoinsOfAPlace, count + i, joins);
    for (std::uint32_t k = 0; k < i; ++k) {
      const double rounding = std::max(outer[i].rounding, outer[k].rounding);
      const double width = clearance_of_line(forest, rounding, outer[k].place, outer[i].place);
      if (width > 0) joins.push_back({count + k, count + i, width});
    }
  }
}

/// The greatest width of a path between two places, 0 if there is none: joins are added from the widest on until both
/// are connected, which is at the last join of a widest path (Kruskal's algorithm; Hu 1961). Sorts the joins.
double greatest_width(std::vector<Join>& joins, std::uint32_t count, std::uint32_t first, std::uint32_t last) {
  std::ranges::stable_sort(joins, [](const Join& a, const Join& b) { return a.width > b.width; });
  DisjointSets sets(count);
  for (const Join& join : joins) {
    sets.join(join.from, join.to);
    if (sets.of(first) == sets.of(last)) return join.width;
  }
  return 0;
}

/// The shortest of the ways that are at least so wide (Dijkstra 1959), the last place first. `length_of(join)`.
template <class Length>
std::vector<std::uint32_t> shortest_way(const std::vector<Join>& joins, std::uint32_t count, std::uint32_t first,
                                        std::uint32_t last, double width, const Length& length_of) {
  std::vector<std::vector<std::uint32_t>> joins_of(count);
  for (std::uint32_t j = 0; j < joins.size() && joins[j].width >= width; ++j) {
    joins_of[joins[j].from].push_back(j);
    joins_of[joins[j].to].push_back(j);
  }
  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::vector<double> way(count, std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(count, SitePath::kNoPoint);
  way[first] = 0;
  open.push({0, first});
  while (!open.empty()) {
    const auto [reached, place] = open.top();
    open.pop();
    if (place == last) break;
    if (reached > way[place]) continue;
    for (const std::uint32_t j : joins_of[place]) {
      const std::uint32_t next = joins[j].from == place ? joins[j].to : joins[j].from;
      const double through = reached + length_of(joins[j]);
      if (!(through < way[next])) continue;
      way[next] = through;
      before[next] = place;
      open.push({through, next});
    }
  }
  std::vector<std::uint32_t> places = {last};
  while (places.back() != first) places.push_back(before[places.back()]);
  return places;
}

}  // namespace

Result<SiteRoadmap> SiteRoadmap::build(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi,
                                       const SiteRoadmapOptions& options, const ProgressCallback& progress,
                                       const std::stop_token& stop) {
  return catch_out_of_memory("making a roadmap", [&]() -> Result<SiteRoadmap> {
    Result<SiteForest> forest = SiteForest::build(sites, options.threads);
    if (!forest) return forest.error();
    auto impl = std::make_shared<Impl>(Impl{std::move(forest).value(), rounding_in(voronoi.grid), {}, {}, {}, 0});
    impl->places.reserve(voronoi.points.size());
    for (const SitePoint& p : voronoi.points) impl->places.push_back({p.point, p.distance - p.error});
    LoopWatch watch(progress, stop);
    try {
      impl->links = find_links(impl->forest, impl->rounding, impl->places, voronoi.points, options.threads, watch);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
    DisjointSets sets(impl->places.size());
    for (const RoadmapLink& link : impl->links) sets.join(link.points[0], link.points[1]);
    impl->component_of_point.resize(impl->places.size());
    for (std::uint32_t i = 0; i < impl->places.size(); ++i) {
      const std::uint32_t first = sets.of(i);
      impl->component_of_point[i] = first == i ? impl->components++ : impl->component_of_point[first];
    }
    return SiteRoadmap(std::move(impl));
  });
}

const std::vector<RoadmapLink>& SiteRoadmap::links() const { return impl_->links; }

const std::vector<std::uint32_t>& SiteRoadmap::component_of_point() const { return impl_->component_of_point; }

std::uint32_t SiteRoadmap::components() const { return impl_->components; }

Result<std::optional<SitePath>> SiteRoadmap::widest_path(const Point& from, const Point& to) const {
  return catch_out_of_memory("finding a path", [&]() -> Result<std::optional<SitePath>> {
    const auto count = static_cast<std::uint32_t>(impl_->places.size());
    std::vector<Join> joins;
    joins.reserve(impl_->links.size());
    for (const RoadmapLink& link : impl_->links) joins.push_back({link.points[0], link.points[1], link.width});
    std::vector<OuterPlace> outer;
    if (Status status = take_ends(impl_->forest, impl_->rounding, {from, to}, outer); !status) return status.error();
    const std::array<ClearPlace, 2> ends = {outer[0].place, outer[1].place};
    for (const ClearPlace& end : ends) add_places_behind(impl_->forest, impl_->rounding, end, outer);
    join_outer_places(impl_->forest, impl_->places, outer, joins);
    const auto all = static_cast<std::uint32_t>(count + outer.size());
    double widest = greatest_width(joins, all, count, count + 1);
    if (!(widest > 0)) {
      for (std::uint32_t e = 0; e < 2; ++e) {
        join_place(impl_->forest, impl_->places, outer[e], impl_->places.size(), count + e, joins);
      }
      widest = greatest_width(joins, all, count, count + 1);
    }
    if (!(widest > 0)) return std::optional<SitePath>();
    SitePath path;
    const auto place = [&](std::uint32_t i) { return i < count ? impl_->places[i].at : outer[i - count].place.at; };
    std::vector<std::uint32_t> way = shortest_way(joins, all, count, count + 1, widest, [&](const Join& join) {
      return length(place(join.from) - place(join.to));
    });
    std::ranges::reverse(way);
    path.width = std::min({widest, ends[0].clearance, ends[1].clearance});
    for (const std::uint32_t i : way) {
      path.line.push_back(place(i));
      path.points.push_back(i < count ? i : SitePath::kNoPoint);
      if (path.line.size() > 1) path.length += length(path.line.back() - path.line[path.line.size() - 2]);
    }
    return std::optional<SitePath>(std::move(path));
  });
}

Status check_path_ends(std::span<const VoronoiSite> sites, const Point& from, const Point& to, unsigned threads) {
  const auto tested = catch_out_of_memory("testing the ends of a path", [&]() -> Result<bool> {
    const Result<SiteForest> forest = SiteForest::build(sites, threads);
    if (!forest) return forest.error();
    std::vector<OuterPlace> outer;
    const double rounding = 0x1p-47 * greatest_coordinate(forest.value().box());
    if (Status status = take_ends(forest.value(), rounding, {from, to}, outer); !status) return status.error();
    return true;
  });
  if (!tested) return tested.error();
  return {};
}

}  // namespace medial_vk
