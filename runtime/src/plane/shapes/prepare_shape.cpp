#include <algorithm>
#include <cmath>
#include <utility>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "medial_vk/plane_shape.h"
#include "plane/shapes/arrangement.h"
#include "plane/shapes/windings.h"

namespace medial_vk {

double ShapeReport::longest_side() const { return std::max(upper[0] - lower[0], upper[1] - lower[1]); }

namespace plane {
namespace {

constexpr double kMostCoordinate = 1e150;  // squares are finite
constexpr std::size_t kMostPoints = std::size_t{1} << 30;

Error invalid(const char* message) { return {ErrorCode::kInvalidMesh, message}; }

/// Points and edges of rings, without repeated points in a row.
struct RingEdges {
  std::vector<PlanePoint> points;
  std::vector<CountedEdge> edges;
};

/// Whether the ring has three different points.
bool encloses(const PlaneRing& ring) {
  const auto differs = [&](const PlanePoint& p) { return p != ring.front(); };
  const auto second = std::ranges::find_if(ring, differs);
  if (second == ring.end()) return false;
  return std::ranges::any_of(ring, [&](const PlanePoint& p) { return p != ring.front() && p != *second; });
}

void add_ring(const PlaneRing& ring, RingEdges& all, ShapeReport& report) {
  if (ring.empty() || !encloses(ring)) {
    ++report.degenerate_rings;
    return;
  }
  ++report.rings;
  const auto first = static_cast<std::uint32_t>(all.points.size());
  for (const PlanePoint& p : ring) {
    if (all.points.size() > first && all.points.back() == p) {
      ++report.merged_points;
    } else {
      all.points.push_back(p);
    }
  }
  const auto count = static_cast<std::uint32_t>(all.points.size()) - first;
  for (std::uint32_t i = 0; i < count; ++i) all.edges.push_back({{first + i, first + (i + 1) % count}, 1});
}

bool is_inside(std::int64_t winding, FillRule rule) {
  return rule == FillRule::kNonZero ? winding != 0 : winding % 2 != 0;
}

/// The edges with the inside on one side, turned so that it is the left one; points that none uses are left out.
void keep_boundary(const Arrangement& arrangement, const std::vector<PlanePoint>& given, const Frame& frame,
                   FillRule rule, PreparedShape& shape) {
  const std::vector<EdgeWindings> sides = windings(arrangement);
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> place(arrangement.points.size(), kUnused);
  const auto place_of = [&](std::uint32_t point) {
    if (place[point] == kUnused) {
      place[point] = static_cast<std::uint32_t>(shape.points.size());
      shape.points.push_back(point < given.size() ? given[point] : frame.to_input(arrangement.points[point]));
    }
    return place[point];
  };
  for (std::size_t e = 0; e < arrangement.edges.size(); ++e) {
    const bool left = is_inside(sides[e].left, rule), right = is_inside(sides[e].right, rule);
    if (left == right) {
      ++shape.report.inner_segments;
      continue;
    }
    std::array<std::uint32_t, 2> ends = arrangement.edges[e].ends;
    if (right) std::swap(ends[0], ends[1]);
    const std::uint32_t begin = place_of(ends[0]);
    shape.segments.push_back({begin, place_of(ends[1])});
  }
}

void measure(PreparedShape& shape) {
  ShapeReport& report = shape.report;
  const PlanePoint origin = shape.points.front();
  for (const auto& [begin, end] : shape.segments) {
    const Vec2 a = {shape.points[begin][0] - origin[0], shape.points[begin][1] - origin[1]};
    const Vec2 b = {shape.points[end][0] - origin[0], shape.points[end][1] - origin[1]};
    report.area += cross(a, b) / 2;
    report.perimeter += distance(a, b);
  }
  const Box box = box_of(shape.points);
  report.lower = {box.lower.x, box.lower.y};
  report.upper = {box.upper.x, box.upper.y};
  report.segments = shape.segments.size();
}

void add(std::vector<std::string>& sentences, std::uint64_t count, const char* one, const char* many) {
  if (count > 0) sentences.push_back(std::to_string(count) + (count == 1 ? one : many));
}

void state_assumptions(ShapeReport& report, FillRule rule) {
  std::vector<std::string>& s = report.assumptions;
  add(s, report.degenerate_rings, " ring has fewer than three different points and is left out.",
      " rings have fewer than three different points and are left out.");
  add(s, report.crossings, " crossing of segments is cut.", " crossings of segments are cut.");
  add(s, report.touching_points, " point lies on another segment, which is cut there.",
      " points lie on other segments, which are cut there.");
  if (report.inner_segments > 0) {
    add(s, report.inner_segments, " segment has the same side of the boundary on both sides and is left out",
        " segments have the same side of the boundary on both sides and are left out");
    s.back() += rule == FillRule::kNonZero ? " (inside is where the winding number is not zero)."
                                           : " (inside is where the winding number is odd).";
  }
}

Result<PreparedShape> prepare(std::span<const PlaneRing> rings, FillRule rule, unsigned threads,
                              const std::stop_token& stop) {
  PreparedShape shape;
  RingEdges all;
  for (const PlaneRing& ring : rings) add_ring(ring, all, shape.report);
  if (all.edges.empty()) return invalid("the shape has no ring of three different points");
  const Frame frame(box_of(all.points), 0);
  std::vector<Vec2> points;
  points.reserve(all.points.size());
  for (const PlanePoint& p : all.points) points.push_back(frame.to_unit(p));
  const ProgressCallback silent;
  const LoopWatch watch(silent, stop);
  const Arrangement arrangement = arrange(std::move(points), all.edges, frame, threads, watch);
  keep_boundary(arrangement, all.points, frame, rule, shape);
  if (shape.segments.empty()) return invalid("the rings of the shape enclose nothing");
  shape.report.merged_points += arrangement.merged_points;
  shape.report.crossings = arrangement.crossings;
  shape.report.touching_points = arrangement.touching_points;
  shape.report.tolerance = kSnap * frame.scale();
  measure(shape);
  state_assumptions(shape.report, rule);
  return shape;
}

Status check(std::span<const PlaneRing> rings) {
  std::size_t points = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    points += rings[i].size();
    for (std::size_t k = 0; k < rings[i].size(); ++k) {
      const bool is_fine = std::ranges::all_of(rings[i][k], [](double x) { return std::fabs(x) <= kMostCoordinate; });
      if (is_fine) continue;
      return Error{ErrorCode::kInvalidMesh, "point " + std::to_string(k) + " of ring " + std::to_string(i) +
                                                " has a coordinate that is not finite or beyond 1e150"};
    }
  }
  if (points >= kMostPoints) return Error{ErrorCode::kUsage, "`rings` must have fewer than 2^30 points"};
  return {};
}

}  // namespace
}  // namespace plane

Result<PreparedShape> prepare_shape(std::span<const PlaneRing> rings, FillRule rule, unsigned threads,
                                    const std::stop_token& stop) {
  if (const Status status = plane::check(rings); !status) return status.error();
  return catch_out_of_memory("preparing a shape", [&]() -> Result<PreparedShape> {
    try {
      return plane::prepare(rings, rule, threads, stop);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
