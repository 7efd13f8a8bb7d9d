#include "medial_vk/plane_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "plane/axis/branches.h"
#include "plane/diagram/diagram.h"
#include "plane/shapes/meetings.h"
#include "plane/sites/frame.h"

namespace medial_vk {
namespace plane {
namespace {

constexpr double kDeepAngle = 0.15;  // the object angle of points that pass by their radius (Section 2.4.2)

Error usage(const char* message) { return {ErrorCode::kUsage, message}; }

Status check_options(double object_angle, double radius, double margin) {
  if (!(object_angle >= 0 && object_angle <= std::numbers::pi / 2)) {
    return usage("`object_angle` must be from 0 to pi / 2");
  }
  if (!(radius >= 0 && std::isfinite(radius))) return usage("`radius` must be a length, or 0");
  if (!(margin >= 0 && std::isfinite(margin))) return usage("`margin` must be a length, or 0");
  return {};
}

PlanePoint pair_of(Vec2 v) { return {v.x, v.y}; }

/// The kinds of nodes have the same order.
constexpr bool is_same(NodeKind kind, AxisNodeKind of_axis) { return static_cast<AxisNodeKind>(kind) == of_axis; }
static_assert(is_same(NodeKind::kMeeting, AxisNodeKind::kMeeting) &&
              is_same(NodeKind::kCorner, AxisNodeKind::kCorner) &&
              is_same(NodeKind::kThreshold, AxisNodeKind::kThreshold) &&
              is_same(NodeKind::kBorder, AxisNodeKind::kBorder));

PlaneCurve curve_in_input(const Bisector& curve, const Frame& frame) {
  PlaneCurve result;
  result.kind = curve.kind() == Bisector::Kind::kOfPoints ? PlaneCurve::Kind::kOfPoints
                : curve.kind() == Bisector::Kind::kMixed  ? PlaneCurve::Kind::kOfPointAndSegment
                                                          : PlaneCurve::Kind::kOfSegments;
  result.origin = frame.to_input(curve.origin());
  result.along = pair_of(curve.along());
  result.up = pair_of(curve.up());
  result.focus = frame.scale() * curve.focus();
  if (result.kind == PlaneCurve::Kind::kOfSegments) {
    result.radius = frame.scale() * curve.radius_at(0);
    result.slope = curve.slope();
    result.angle = curve.object_angle_at(0);
  }
  return result;
}

PlaneAxis in_input(const Diagram& diagram, const SiteSet& sites, const DiagramQuery& query, const Frame& frame) {
  PlaneAxis axis;
  axis.nodes.reserve(diagram.nodes.size());
  for (const DiagramNode& node : diagram.nodes) {
    axis.nodes.push_back({frame.to_input(node.circle.centre), frame.scale() * node.circle.radius, node.object_angle,
                          static_cast<AxisNodeKind>(node.kind), 0});
  }
  const auto contact = [&](Contact c) {
    const bool is_point = sites.is_point(c.site);
    return PlaneContact{is_point, is_point ? c.site : c.site - sites.points()};
  };
  axis.arcs.reserve(diagram.arcs.size());
  for (const DiagramArc& arc : diagram.arcs) {
    axis.arcs.push_back({curve_in_input(arc.curve, frame),
                         arc.nodes,
                         {frame.scale() * arc.t[0], frame.scale() * arc.t[1]},
                         {contact(arc.contacts[0]), contact(arc.contacts[1])}});
  }
  axis.cells = diagram.cells;
  const double across = tie(1) / std::sin(query.least_angle(1));  // of points that are accepted as equally far
  axis.epsilon = frame.scale() * std::max({diagram.clustered, kEpsilon, across}) + frame.rounding();
  set_branches(axis);
  return axis;
}

std::vector<Vec2> in_units(std::span<const PlanePoint> points, const Frame& frame) {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const PlanePoint& p : points) result.push_back(frame.to_unit(p));
  return result;
}

/// In the frame's coordinates.
struct Extent {
  Frame frame;
  double half;
};

Extent extent_of(std::span<const PlanePoint> points, double margin, bool is_bounded) {
  const Box box = box_of(points);
  if (margin == 0) margin = box.longest_side() / 2;
  if (is_bounded) margin = 0;
  const Frame frame(box, margin);
  // Of a shape, a little more than the box, so that no corner lies on the border of the search.
  const double half = (box.longest_side() / 2 + margin) / frame.scale();
  return {frame, is_bounded ? half * (1 + 0x1p-20) : half};
}

Result<PlaneAxis> find(const SiteSet& sites, const DiagramQuery& query, const Frame& frame,
                       const ProgressCallback& progress, const std::stop_token& stop) {
  LoopWatch watch(progress, stop);
  return in_input(find_diagram(sites, query, watch), sites, query, frame);
}

Result<PlaneAxis> axis_of_shape(const PreparedShape& shape, const PlaneAxisOptions& options,
                                const ProgressCallback& progress, const std::stop_token& stop) {
  const auto [frame, half] = extent_of(shape.points, options.margin, options.side == PlaneSide::kInside);
  const SiteSet sites(in_units(shape.points, frame), shape.segments, {}, {});
  DiagramQuery query;
  query.wanted = options.side == PlaneSide::kInside    ? Wanted::kLeft
                 : options.side == PlaneSide::kOutside ? Wanted::kRight
                                                       : Wanted::kBothSides;
  query.object_angle = std::max(options.object_angle, kLeastAngle);
  query.deep_angle = kDeepAngle;
  if (options.radius > 0) query.radius = options.radius / frame.scale();
  query.half = half;
  query.threads = options.threads;
  return find(sites, query, frame, progress, stop);
}

Status check_sites(const PlaneSites& sites) {
  const auto invalid = [](std::string message) { return Error{ErrorCode::kInvalidMesh, std::move(message)}; };
  if (sites.site_of_point.size() != sites.points.size() || sites.site_of_segment.size() != sites.segments.size()) {
    return usage("`site_of_point` and `site_of_segment` must have one number for each point and segment");
  }
  for (std::size_t i = 0; i < sites.points.size(); ++i) {
    if (std::ranges::all_of(sites.points[i], [](double x) { return std::fabs(x) <= 1e150; })) continue;
    return invalid("point " + std::to_string(i) + " has a coordinate that is not finite or beyond 1e150");
  }
  for (std::size_t i = 0; i < sites.segments.size(); ++i) {
    const auto& [a, b] = sites.segments[i];
    if (std::max(a, b) >= sites.points.size())
      return invalid("segment " + std::to_string(i) + " uses an index out of range");
    if (sites.points[a] == sites.points[b]) return invalid("segment " + std::to_string(i) + " has no length");
  }
  const auto differs = [&](std::uint32_t site) { return site != sites.site_of_point.front(); };
  if (sites.points.empty() || std::ranges::none_of(sites.site_of_point, differs)) {
    return invalid("at least two sites are needed");
  }
  return {};
}

/// The proofs of the diagram presume that different sites have no point in common. A site may meet itself: no curve
/// between two sites passes there.
Status check_apart(const SiteSet& sites, unsigned threads, const LoopWatch& watch) {
  for (const Meeting& m : find_meetings(sites, threads, watch)) {
    const std::uint32_t a = sites.owner(m.first), b = sites.owner(m.second);
    if (a == b) continue;
    return Error{ErrorCode::kInvalidMesh, "sites " + std::to_string(std::min(a, b)) + " and " +
                                              std::to_string(std::max(a, b)) +
                                              " cross or touch; sites in the plane must be apart"};
  }
  return {};
}

Result<PlaneAxis> voronoi_of_sites(const PlaneSites& given, const PlaneVoronoiOptions& options,
                                   const ProgressCallback& progress, const std::stop_token& stop) {
  const auto [frame, half] = extent_of(given.points, options.margin, false);
  const SiteSet sites(in_units(given.points, frame), given.segments, given.site_of_point, given.site_of_segment);
  const LoopWatch watch(progress, stop);
  if (const Status status = check_apart(sites, options.threads, watch); !status) return status.error();
  DiagramQuery query;
  query.wanted = Wanted::kBetweenOwners;
  query.object_angle = std::max(options.object_angle, kLeastAngle);
  query.half = half;
  query.threads = options.threads;
  return find(sites, query, frame, progress, stop);
}

template <class Work>
Result<PlaneAxis> guarded(const char* doing, const Work& work) {
  return catch_out_of_memory(doing, [&]() -> Result<PlaneAxis> {
    try {
      return work();
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace
}  // namespace plane

Result<PlaneAxis> find_plane_axis(const PreparedShape& shape, const PlaneAxisOptions& options,
                                  const ProgressCallback& progress, const std::stop_token& stop) {
  if (const Status status = plane::check_options(options.object_angle, options.radius, options.margin); !status) {
    return status.error();
  }
  if (shape.segments.empty()) return Error{ErrorCode::kInvalidMesh, "the shape has no segments"};
  return plane::guarded("finding a medial axis", [&] { return plane::axis_of_shape(shape, options, progress, stop); });
}

Result<PlaneAxis> find_plane_voronoi(const PlaneSites& sites, const PlaneVoronoiOptions& options,
                                     const ProgressCallback& progress, const std::stop_token& stop) {
  if (const Status status = plane::check_options(options.object_angle, 0, options.margin); !status) {
    return status.error();
  }
  if (const Status status = plane::check_sites(sites); !status) return status.error();
  return plane::guarded("finding a Voronoi diagram",
                        [&] { return plane::voronoi_of_sites(sites, options, progress, stop); });
}

}  // namespace medial_vk
