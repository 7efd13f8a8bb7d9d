#include "mesh/crossings/cut_crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/split_mix.h"
#include "mesh/crossings/crossing_segments.h"
#include "mesh/crossings/cut_triangle.h"

namespace medial_vk {
namespace {

/// The transform to the grid: x -> (x - centre) / scale, within [-1/2, 1/2].
struct ToGrid {
  Point centre{};
  double scale = 1;

  explicit ToGrid(const Mesh& mesh) {
    Point lower = mesh.vertices.front(), upper = lower;
    for (const Point& p : mesh.vertices) {
      lower = least(lower, p);
      upper = greatest(upper, p);
    }
    const Point extent = upper - lower;
    centre = lower + 0.5 * extent;
    // A power of two, so that the division is exact.
    scale = std::exp2(std::ceil(std::log2(std::max({extent[0], extent[1], extent[2]}))));
  }

  Point operator()(const Point& p) const { return (1 / scale) * (p - centre); }
  Point inverse(const Point& p) const { return centre + scale * p; }
};

class CrossingCutter {
 public:
  CrossingCutter(const Mesh& mesh, const TriangleTree& tree, const SelfIntersections& intersections, unsigned threads)
      : mesh_(mesh), tree_(tree), crossed_(intersections.crossed), threads_(threads), to_grid_(mesh) {}

  CutMesh run() {
    constexpr std::uint64_t kAttempts = 4;
    for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
      place_on_grid(attempt);
      std::optional<Crossings> crossings = find_crossings(mesh_, grid_, tree_, crossed_, threads_);
      if (!crossings) continue;
      crossings_ = std::move(*crossings);
      if (triangulate()) return assemble();
    }
    return unchanged();
  }

 private:
  /// As given first, as most meshes cross in general position. Then every vertex is moved outwards, and by less at
  /// random: faces that touch overlap, and of faces that coincide one covers the other.
  void place_on_grid(std::uint64_t attempt) {
    grid_.of_vertex.clear();
    for (const Point& p : mesh_.vertices) grid_.of_vertex.push_back(to_grid_(p));
    if (attempt > 0) move_outwards(attempt);
    for (Point& p : grid_.of_vertex) p = snap_to_grid(p);
  }

  void move_outwards(std::uint64_t attempt) {
    if (outwards_.empty()) find_outward_directions();
    const double distance = 0x1p-36 * std::exp2(static_cast<double>(attempt));
    SplitMix random(attempt);
    for (std::size_t i = 0; i < outwards_.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        grid_.of_vertex[i][k] += distance * (outwards_[i][k] + 0.25 * random.symmetric());
    }
    grid_.moved = 1.5 * distance * to_grid_.scale;
  }

  /// The sum of the unit normals of the triangles around each vertex, as a unit vector or 0.
  void find_outward_directions() {
    outwards_.assign(mesh_.vertices.size(), Point{0, 0, 0});
    for (const Triangle& t : mesh_.triangles) {
      const Point normal =
          cross(mesh_.vertices[t[1]] - mesh_.vertices[t[0]], mesh_.vertices[t[2]] - mesh_.vertices[t[0]]);
      const double size = length(normal);
      if (!(size > 0)) continue;
      for (const std::uint32_t v : t) outwards_[v] = outwards_[v] + (1 / size) * normal;
    }
    for (Point& direction : outwards_) {
      const double size = length(direction);
      if (size > 1) direction = (1 / size) * direction;
    }
  }

  bool triangulate() {
    cut_.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!crossings_.segments[t].empty() || !points_on_edges(t).empty()) cut_.push_back(t);
    }
    parts_.assign(cut_.size(), {});
    std::vector<char> failed(cut_.size(), 0);
    parallel_for(cut_.size(), 8, threads_, [&](std::size_t i) { failed[i] = !cut(cut_[i], parts_[i]); });
    return std::ranges::none_of(failed, [](char f) { return f != 0; });
  }

  std::vector<std::uint32_t> points_on_edges(std::uint32_t t) const {
    std::vector<std::uint32_t> points;
    const Triangle& c = mesh_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      const auto on_edge = crossings_.on_edges.find({std::min(a, b), std::max(a, b)});
      if (on_edge != crossings_.on_edges.end())
        points.insert(points.end(), on_edge->second.begin(), on_edge->second.end());
    }
    return points;
  }

  /// The parts of one triangle, by the numbers of their points in the cut mesh.
  bool cut(std::uint32_t t, std::vector<Triangle>& parts) const {
    const Triangle& corners = mesh_.triangles[t];
    ExactGeometry geometry;
    CutTriangle inside(geometry,
                       {grid_.of_vertex[corners[0]], grid_.of_vertex[corners[1]], grid_.of_vertex[corners[2]]});
    std::vector<std::uint32_t> points(corners.begin(), corners.end());  // by local number
    std::unordered_map<std::uint32_t, std::uint32_t> numbers = {{corners[0], 0}, {corners[1], 1}, {corners[2], 2}};
    const auto local = [&](std::uint32_t point) -> std::optional<std::uint32_t> {
      const auto [known, is_new] = numbers.try_emplace(point, static_cast<std::uint32_t>(points.size()));
      if (!is_new) return known->second;
      if (point < mesh_.vertices.size() || !inside.insert(crossings_.points[point - mesh_.vertices.size()]))
        return std::nullopt;
      points.push_back(point);
      return known->second;
    };
    for (const std::uint32_t point : points_on_edges(t)) {
      if (!local(point)) return false;
    }
    for (const std::uint32_t point : crossings_.inside[t]) {
      if (!local(point)) return false;
    }
    std::vector<std::array<std::uint32_t, 2>> segments;
    for (const CrossingSegment& segment : crossings_.segments[t]) {
      const auto from = local(segment.from), to = local(segment.to);
      if (!from || !to) return false;
      segments.push_back({*from, *to});
    }
    for (const auto& [from, to] : segments) {
      if (!inside.add_segment(from, to)) return false;
    }
    inside.improve();
    for (const auto& part : inside.triangles()) parts.push_back({points[part[0]], points[part[1]], points[part[2]]});
    return true;
  }

  CutMesh assemble() const {
    CutMesh out;
    out.vertices = mesh_.vertices;
    for (const Point& p : grid_.of_vertex) out.decided.push_back(to_grid_.inverse(p));
    for (const ExactPoint& point : crossings_.points) {
      out.vertices.push_back(to_grid_.inverse(point.near));
      out.decided.push_back(out.vertices.back());
    }
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (next == cut_.size() || cut_[next] != t) {
        out.triangles.push_back(mesh_.triangles[t]);
        out.source.push_back(t);
        continue;
      }
      for (const Triangle& part : parts_[next]) {
        out.triangles.push_back(part);
        out.source.push_back(t);
      }
      ++next;
    }
    out.cut_triangles = cut_.size();
    return out;
  }

  CutMesh unchanged() const {
    CutMesh out;
    out.vertices = out.decided = mesh_.vertices;
    out.triangles = mesh_.triangles;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) out.source.push_back(t);
    out.uncut = crossed_;
    return out;
  }

  const Mesh& mesh_;
  const TriangleTree& tree_;
  const std::vector<bool>& crossed_;
  const unsigned threads_;
  const ToGrid to_grid_;
  std::vector<Point> outwards_;  // by vertex, if there was a degenerate position
  GridPositions grid_;
  Crossings crossings_;
  std::vector<std::uint32_t> cut_;            // triangles, ascending
  std::vector<std::vector<Triangle>> parts_;  // of each of them
};

}  // namespace

CutMesh cut_crossings(const Mesh& mesh, const TriangleTree& tree, const SelfIntersections& intersections,
                      unsigned threads) {
  return CrossingCutter(mesh, tree, intersections, threads).run();
}

}  // namespace medial_vk
