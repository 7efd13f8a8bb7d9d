#include "site_voronoi/widest_way.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "base/disjoint_sets.h"
#include "site_voronoi/grid_rounding.h"

namespace medial_vk {
namespace {

constexpr std::size_t kJoinsOfAPlace = 128;                      // that are tested
constexpr std::array<double, 4> kStepsFromAnEnd = {1, 2, 4, 8};  // of its clearance

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
                std::size_t most, std::uint32_t number, std::vector<PlaceJoin>& joins) {
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
    if (width > 0) joins.push_back({number, i, width, way(i)});
  }
}

/// Of places that are none of the graph, to it and to each other.
void join_outer_places(const SiteForest& forest, const std::vector<ClearPlace>& places,
                       const std::vector<OuterPlace>& outer, std::vector<PlaceJoin>& joins) {
  const auto count = static_cast<std::uint32_t>(places.size());
  for (std::uint32_t i = 0; i < outer.size(); ++i) {
    join_place(forest, places, outer[i], kJoinsOfAPlace, count + i, joins);
    for (std::uint32_t k = 0; k < i; ++k) {
      const double rounding = std::max(outer[i].rounding, outer[k].rounding);
      const double width = clearance_of_line(forest, rounding, outer[k].place, outer[i].place);
      if (width > 0) joins.push_back({count + k, count + i, width, length(outer[i].place.at - outer[k].place.at)});
    }
  }
}

/// The greatest width of a path between two places, 0 if there is none: joins are added from the widest on until both
/// are connected, which is at the last join of a widest path (Kruskal's algorithm; Hu 1961). Sorts the joins.
double greatest_width(std::vector<PlaceJoin>& joins, std::uint32_t count, std::uint32_t first, std::uint32_t last) {
  std::ranges::stable_sort(joins, [](const PlaceJoin& a, const PlaceJoin& b) { return a.width > b.width; });
  DisjointSets sets(count);
  for (const PlaceJoin& join : joins) {
    sets.join(join.from, join.to);
    if (sets.of(first) == sets.of(last)) return join.width;
  }
  return 0;
}

/// The shortest of the ways that are at least so wide (Dijkstra 1959).
std::vector<WayStep> shortest_way(const std::vector<PlaceJoin>& joins, std::uint32_t count, std::uint32_t first,
                                  std::uint32_t last, double width) {
  std::vector<std::vector<std::uint32_t>> joins_of(count);
  for (std::uint32_t j = 0; j < joins.size() && joins[j].width >= width; ++j) {
    joins_of[joins[j].from].push_back(j);
    joins_of[joins[j].to].push_back(j);
  }
  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::vector<double> way(count, std::numeric_limits<double>::infinity());
  std::vector<WayStep> before(count);  // the place, and the curve that leads from it
  way[first] = 0;
  open.push({0, first});
  while (!open.empty()) {
    const auto [reached, place] = open.top();
    open.pop();
    if (place == last) break;
    if (reached > way[place]) continue;
    for (const std::uint32_t j : joins_of[place]) {
      const std::uint32_t next = joins[j].from == place ? joins[j].to : joins[j].from;
      const double through = reached + joins[j].length;
      if (!(through < way[next])) continue;
      way[next] = through;
      before[next] = {place, joins[j].curve};
      open.push({through, next});
    }
  }
  std::vector<WayStep> steps;
  for (std::uint32_t place = last; place != first; place = before[place].place) {
    steps.push_back({place, before[place].curve});
  }
  steps.push_back({first});
  std::ranges::reverse(steps);
  return steps;
}

}  // namespace

Status check_ends(const SiteForest& forest, double rounding, const std::array<Point, 2>& ends) {
  std::vector<OuterPlace> outer;
  return take_ends(forest, rounding, ends, outer);
}

Result<std::optional<WidestWay>> find_widest_way(const SiteForest& forest, double rounding,
                                                 const std::vector<ClearPlace>& places, std::vector<PlaceJoin> joins,
                                                 const std::array<Point, 2>& ends) {
  std::vector<OuterPlace> outer;
  if (Status status = take_ends(forest, rounding, ends, outer); !status) return status.error();
  const std::array<ClearPlace, 2> clear_ends = {outer[0].place, outer[1].place};
  for (const ClearPlace& end : clear_ends) add_places_behind(forest, rounding, end, outer);
  join_outer_places(forest, places, outer, joins);
  const auto count = static_cast<std::uint32_t>(places.size());
  const auto all = static_cast<std::uint32_t>(count + outer.size());
  double widest = greatest_width(joins, all, count, count + 1);
  if (!(widest > 0)) {
    for (std::uint32_t e = 0; e < 2; ++e) join_place(forest, places, outer[e], places.size(), count + e, joins);
    widest = greatest_width(joins, all, count, count + 1);
  }
  if (!(widest > 0)) return std::optional<WidestWay>();
  WidestWay way;
  way.steps = shortest_way(joins, all, count, count + 1, widest);
  way.width = std::min({widest, clear_ends[0].clearance, clear_ends[1].clearance});
  way.beside.reserve(outer.size());
  for (const OuterPlace& place : outer) way.beside.push_back(place.place);
  return std::optional<WidestWay>(std::move(way));
}

}  // namespace medial_vk
