#include "medial_vk/plane_roadmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/host_memory.h"
#include "medial_vk/plane_centre_line.h"
#include "site_voronoi/grid_rounding.h"
#include "site_voronoi/widest_way.h"

namespace medial_vk {

struct PlaneRoadmap::Impl {
  SiteForest forest;
  double rounding = 0;
  PlaneAxis curves;
  std::vector<ClearPlace> places;  // by node
  std::vector<PlaneRoadmapLink> links;
  std::vector<std::uint32_t> component_of_node;
  std::uint32_t components = 0;
};

namespace {

constexpr std::size_t kFeetOfAnEnd = 64;  // points of arcs that an end is joined to, the nearest ones
constexpr double kStepOfPath = 0x1p-11;   // deviation of a path from its arcs, over the width
constexpr unsigned kStepsToAFoot = 8;     // of Newton's method

Point in_space(const PlanePoint& p) { return {p[0], p[1], 0}; }

/// Segments and points of the plane as those of space. Points that segments end in are elements of these.
std::vector<VoronoiSite> sites_in_space(const PlaneSites& sites) {
  std::map<std::uint32_t, VoronoiSite> by_number;
  std::vector<bool> is_end(sites.points.size(), false);
  for (std::size_t i = 0; i < sites.segments.size(); ++i) {
    const auto& [a, b] = sites.segments[i];
    is_end[a] = is_end[b] = true;
    by_number[sites.site_of_segment[i]].segments.push_back({in_space(sites.points[a]), in_space(sites.points[b])});
  }
  for (std::size_t i = 0; i < sites.points.size(); ++i) {
    if (!is_end[i]) by_number[sites.site_of_point[i]].points.push_back(in_space(sites.points[i]));
  }
  std::vector<VoronoiSite> out;
  out.reserve(by_number.size());
  for (auto& [number, site] : by_number) out.push_back(std::move(site));
  return out;
}

/// The least radius of a part of a curve: it is linear, or convex with its least value at t = 0.
double least_radius(const PlaneCurve& curve, double from, double to) {
  const double of_ends = std::min(curve.radius_at(from), curve.radius_at(to));
  const bool has_apex = curve.kind != PlaneCurve::Kind::kOfSegments && from < 0 && to > 0;
  return has_apex ? std::min(of_ends, curve.radius_at(0)) : of_ends;
}

/// A place on an arc: a node, or a foot of an end of a path.
struct PlaceOnArc {
  double t = 0;
  std::uint32_t place = 0;
};

/// The part of an arc between two of its places. A point of it is within epsilon of the exact curve, whose radius
/// differs from that of the part by no more, and distances change by no more than the way: no site is nearer than the
/// least radius less 2 epsilon. The places are beside the ends of the part by rounding, and a straight way from one to
/// the other is beside a straight part by no more.
PlaceJoin join_along(const PlaneAxis& curves, std::uint32_t number, const std::vector<ClearPlace>& places,
                     const PlaceOnArc& from, const PlaceOnArc& to) {
  const PlaneCurve& curve = curves.arcs[number].curve;
  double width = least_radius(curve, from.t, to.t) - 2 * curves.epsilon, beside = 0;
  for (const PlaceOnArc* end : {&from, &to}) {
    const ClearPlace& place = places[end->place];
    width = std::min(width, place.clearance);
    beside = std::max(beside, length(place.at - in_space(curve.point_at(end->t))));
  }
  return {from.place, to.place, width - beside, curve.length(from.t, to.t), number};
}

/// The parameter of a point of the arc that is about as near to p as any: exact on a line.
double foot_on(const AxisArc& arc, const PlanePoint& p) {
  const PlaneCurve& curve = arc.curve;
  const PlanePoint off = {p[0] - curve.origin[0], p[1] - curve.origin[1]};
  const double along = off[0] * curve.along[0] + off[1] * curve.along[1];
  double t = std::clamp(along, arc.t[0], arc.t[1]);
  if (curve.kind != PlaneCurve::Kind::kOfPointAndSegment) return t;
  const double up = off[0] * curve.up[0] + off[1] * curve.up[1];
  for (unsigned i = 0; i < kStepsToAFoot; ++i) {
    const double slope = t / curve.focus;
    const double step = (along - t + (up - curve.radius_at(t)) * slope) / (1 + slope * slope);
    t = std::clamp(t + step, arc.t[0], arc.t[1]);
  }
  return t;
}

/// A point of an arc that an end may be joined to.
struct Foot {
  double way = 0;
  std::uint32_t arc = 0;
  double t = 0;
};

/// The nearest ones, at most one on each arc, none at its ends.
std::vector<Foot> feet_of(const PlaneAxis& curves, const PlanePoint& end) {
  std::vector<Foot> feet;
  for (std::uint32_t a = 0; a < curves.arcs.size(); ++a) {
    const AxisArc& arc = curves.arcs[a];
    const double t = foot_on(arc, end);
    if (!(t > arc.t[0] && t < arc.t[1])) continue;
    feet.push_back({length(in_space(arc.curve.point_at(t)) - in_space(end)), a, t});
  }
  const auto most = static_cast<std::ptrdiff_t>(std::min(feet.size(), kFeetOfAnEnd));
  std::partial_sort(feet.begin(), feet.begin() + most, feet.end(),
                    [](const Foot& a, const Foot& b) { return std::pair(a.way, a.arc) < std::pair(b.way, b.arc); });
  feet.resize(static_cast<std::size_t>(most));
  return feet;
}

/// The graph with the feet of both ends of a path as further places.
struct DividedGraph {
  std::vector<ClearPlace> places;
  std::vector<PlaceJoin> joins;
  std::map<std::uint32_t, std::vector<PlaceOnArc>> on_arc;  // of those with feet, in the order of t
};

/// Polylines of arcs, and straight lines.
class PathMaker {
 public:
  PathMaker(const PlaneAxis& curves, const DividedGraph& graph, const WidestWay& way)
      : curves_(curves), graph_(graph), way_(way), step_(kStepOfPath * way.width) {}

  PlanePath make() {
    path_.width = way_.width;
    add(place(way_.steps.front().place));
    for (std::size_t i = 1; i < way_.steps.size(); ++i) {
      const WayStep& step = way_.steps[i];
      if (step.curve != PlaceJoin::kStraight) follow(step.curve, way_.steps[i - 1].place, step.place);
      add(place(step.place));
    }
    return std::move(path_);
  }

 private:
  PlanePoint place(std::uint32_t i) const {
    const std::size_t count = graph_.places.size();
    const Point& at = i < count ? graph_.places[i].at : way_.beside[i - count].at;
    return {at[0], at[1]};
  }

  /// The inner points of an arc between two of its places.
  void follow(std::uint32_t number, std::uint32_t from, std::uint32_t to) {
    AxisArc part = curves_.arcs[number];
    // Straight arcs bend nowhere.
    if (part.curve.kind != PlaneCurve::Kind::kOfPointAndSegment) return;
    const double begin = parameter(number, from), end = parameter(number, to);
    part.t = {std::min(begin, end), std::max(begin, end)};
    part.nodes = {0, 1};
    PlaneAxis alone;
    alone.nodes.resize(2);
    for (std::size_t k = 0; k < 2; ++k) alone.nodes[k].point = part.curve.point_at(part.t[k]);
    alone.arcs = {part};
    const AxisBranch branch = {{0, 1}, {0}, {begin > end}, 0};
    for (const AxisSample& sample : sample_branch(alone, branch, step_)) add(sample.point);
    // Each point of the polyline is within a step of the arc.
    path_.width = std::min(path_.width, way_.width - step_);
  }

  double parameter(std::uint32_t number, std::uint32_t at) const {
    const AxisArc& arc = curves_.arcs[number];
    if (at == arc.nodes[0]) return arc.t[0];
    if (at == arc.nodes[1]) return arc.t[1];
    const std::vector<PlaceOnArc>& places = graph_.on_arc.at(number);
    return std::ranges::find(places, at, &PlaceOnArc::place)->t;
  }

  void add(const PlanePoint& p) {
    if (!path_.line.empty()) {
      if (path_.line.back() == p) return;
      path_.length += length(in_space(p) - in_space(path_.line.back()));
    }
    path_.line.push_back(p);
  }

  const PlaneAxis& curves_;
  const DividedGraph& graph_;
  const WidestWay& way_;
  double step_;
  PlanePath path_;
};

Status check_numbers(const PlaneSites& sites) {
  const auto is_number = [&](const std::array<std::uint32_t, 2>& ends) {
    return ends[0] < sites.points.size() && ends[1] < sites.points.size();
  };
  if (std::ranges::all_of(sites.segments, is_number) && sites.site_of_point.size() == sites.points.size() &&
      sites.site_of_segment.size() == sites.segments.size()) {
    return {};
  }
  return Error{ErrorCode::kInvalidMesh, "a segment uses an index out of range, or sites are missing"};
}

}  // namespace

Result<PlaneRoadmap> PlaneRoadmap::build(const PlaneSites& sites, const PlaneAxis& curves,
                                         const PlaneRoadmapOptions& options) {
  return catch_out_of_memory("making a roadmap", [&]() -> Result<PlaneRoadmap> {
    if (Status status = check_numbers(sites); !status) return status.error();
    Result<SiteForest> forest = SiteForest::build(sites_in_space(sites), options.threads);
    if (!forest) return forest.error();
    auto impl = std::make_shared<Impl>(Impl{std::move(forest).value(), 0, curves, {}, {}, {}, 0});
    double greatest = greatest_coordinate(impl->forest.box());
    for (const AxisNode& node : curves.nodes) {
      greatest = std::max({greatest, std::fabs(node.point[0]), std::fabs(node.point[1])});
    }
    // As rounding_in() of a grid that holds all: its longest side is at most 2 M, and 32 u 2 M + 28 u M < 2^-46 M.
    impl->rounding = 0x1p-46 * greatest;
    impl->places.reserve(curves.nodes.size());
    for (const AxisNode& node : curves.nodes) {
      const Point at = in_space(node.point);
      impl->places.push_back({at, impl->forest.distance(at) - impl->rounding});
    }
    DisjointSets sets(curves.nodes.size());
    for (std::uint32_t a = 0; a < curves.arcs.size(); ++a) {
      const AxisArc& arc = curves.arcs[a];
      const PlaceJoin join = join_along(curves, a, impl->places, {arc.t[0], arc.nodes[0]}, {arc.t[1], arc.nodes[1]});
      if (!(join.width > 0)) continue;
      impl->links.push_back({a, join.length, join.width});
      sets.join(arc.nodes[0], arc.nodes[1]);
    }
    impl->component_of_node.resize(curves.nodes.size());
    for (std::uint32_t i = 0; i < curves.nodes.size(); ++i) {
      const std::uint32_t first = sets.of(i);
      impl->component_of_node[i] = first == i ? impl->components++ : impl->component_of_node[first];
    }
    return PlaneRoadmap(std::move(impl));
  });
}

const std::vector<PlaneRoadmapLink>& PlaneRoadmap::links() const { return impl_->links; }

const std::vector<std::uint32_t>& PlaneRoadmap::component_of_node() const { return impl_->component_of_node; }

std::uint32_t PlaneRoadmap::components() const { return impl_->components; }

Result<std::optional<PlanePath>> PlaneRoadmap::widest_path(const PlanePoint& from, const PlanePoint& to) const {
  return catch_out_of_memory("finding a path", [&]() -> Result<std::optional<PlanePath>> {
    const std::array<Point, 2> ends = {in_space(from), in_space(to)};
    if (Status status = check_ends(impl_->forest, impl_->rounding, ends); !status) return status.error();
    DividedGraph graph;
    graph.places = impl_->places;
    for (const PlanePoint& end : {from, to}) {
      for (const Foot& foot : feet_of(impl_->curves, end)) {
        const Point at = in_space(impl_->curves.arcs[foot.arc].curve.point_at(foot.t));
        graph.on_arc[foot.arc].push_back({foot.t, static_cast<std::uint32_t>(graph.places.size())});
        graph.places.push_back({at, impl_->forest.distance(at) - impl_->rounding});
      }
    }
    for (const PlaneRoadmapLink& link : impl_->links) {
      const AxisArc& arc = impl_->curves.arcs[link.arc];
      PlaceOnArc before = {arc.t[0], arc.nodes[0]};
      const auto divide = [&](const PlaceOnArc& next) {
        const PlaceJoin join = join_along(impl_->curves, link.arc, graph.places, before, next);
        if (join.width > 0) graph.joins.push_back(join);
        before = next;
      };
      if (const auto feet = graph.on_arc.find(link.arc); feet != graph.on_arc.end()) {
        std::ranges::stable_sort(feet->second, {}, &PlaceOnArc::t);
        for (const PlaceOnArc& foot : feet->second) divide(foot);
      }
      divide({arc.t[1], arc.nodes[1]});
    }
    const Result<std::optional<WidestWay>> way =
        find_widest_way(impl_->forest, impl_->rounding, graph.places, graph.joins, ends);
    if (!way) return way.error();
    if (!way.value()) return std::optional<PlanePath>();
    return std::optional<PlanePath>(PathMaker(impl_->curves, graph, *way.value()).make());
  });
}

}  // namespace medial_vk
