#include "mesh/inner_patches.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"
#include "mesh/winding/winding_number.h"
#include "mesh/winding_change.h"

namespace medial_vk {
namespace {

/// A patch lies inside if the winding number without itself is at least this beside every sample of it: 1/2 behind and
/// in front, and a margin above the error of WindingTree.
constexpr double kInside = 1.05;
/// Or if it and that of the other components are at least this: 1/2, and a margin for two values. It is lower than 1
/// only where its own component is open; beside the wall of a cavity it is 1/2.
constexpr double kInsideOthers = 0.6;

/// Where all components are closed, a patch has one value, and its largest triangles are evaluated, which are the
/// farthest from others. Where some are open, all triangles are, near their corners, too, but for those so thin that
/// rounding decides their value.
constexpr std::size_t kSamples = 64;
constexpr double kThin = 0x1p-30;  // of the area of the largest triangle of the patch

double area(const std::array<Point, 3>& corners) {
  return length(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
}

/// The centroid, and a point near each corner.
std::array<Point, 4> points_of(const std::array<Point, 3>& corners) {
  const Point centroid = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
  std::array<Point, 4> points = {centroid, centroid, centroid, centroid};
  for (std::size_t k = 0; k < 3; ++k) points[k + 1] = centroid + 0.9 * (corners[k] - centroid);
  return points;
}

/// The winding numbers of one component.
class ComponentField {
 public:
  /// `triangles`: those of the component.
  ComponentField(const Mesh& mesh, const std::vector<std::uint32_t>& triangles)
      : part_(copy(mesh, triangles)), tree_(part_), winding_(tree_), position_of_(triangles.size()) {
    for (std::uint32_t position = 0; position < tree_.order.size(); ++position)
      position_of_[tree_.order[position]] = position;
  }

  /// Beside a point of its triangle with this number, without that triangle.
  double beside(std::uint32_t number, const Point& p) const { return winding_.beside(position_of_[number], p); }

 private:
  static Mesh copy(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
    Mesh part;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t t : triangles) {
      Triangle corners = mesh.triangles[t];
      for (std::uint32_t& v : corners) {
        const auto [known, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(part.vertices.size()));
        if (is_new) part.vertices.push_back(mesh.vertices[v]);
        v = known->second;
      }
      part.triangles.push_back(corners);
    }
    return part;
  }

  Mesh part_;
  TriangleTree tree_;
  WindingTree winding_;
  std::vector<std::uint32_t> position_of_;
};

class BoundaryFinder {
 public:
  BoundaryFinder(CutMesh cut, const std::vector<std::uint32_t>& component_of, unsigned threads)
      : component_of_(component_of),
        cut_(std::move(cut)),
        mesh_{std::move(cut_.vertices), std::move(cut_.triangles), 0, 0},
        topology_(mesh_),
        parts_(find_parts(mesh_, topology_)),
        threads_(threads) {}

  /// By triangle of the cut: 1 if its patch lies inside and has a triangle from this one of the mesh on.
  std::vector<char> lie_inside(std::size_t first) {
    find_inner_patches(first);
    std::vector<char> inside;
    for (const std::uint32_t patch : parts_.patch_of) inside.push_back(is_inner_[patch]);
    return inside;
  }

  OuterBoundary run() {
    find_inner_patches(0);
    restore_openings();
    OuterBoundary out;
    out.mesh.vertices = std::move(mesh_.vertices);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_inner_[parts_.patch_of[t]]) {
        ++out.inner_triangles;
        continue;
      }
      out.mesh.triangles.push_back(mesh_.triangles[t]);
      out.source.push_back(cut_.source[t]);
    }
    out.cut_triangles = cut_.cut_triangles;
    return out;
  }

 private:
  /// Of those that have a triangle from this one of the mesh on.
  void find_inner_patches(std::size_t first) {
    std::swap(mesh_.vertices, cut_.decided);
    const TriangleTree tree(mesh_);
    const WindingTree winding(tree);
    find_component_fields();
    std::swap(mesh_.vertices, cut_.decided);
    std::vector<std::vector<std::uint32_t>> positions(parts_.patches);  // in the tree
    for (std::uint32_t position = 0; position < tree.order.size(); ++position)
      positions[parts_.patch_of[tree.order[position]]].push_back(position);
    const bool is_closed = balance_everywhere();
    const WindingChange change(mesh_, topology_);
    is_inner_.assign(parts_.patches, 0);
    is_covered_.assign(mesh_.triangles.size(), 0);
    std::vector<char> is_wanted(parts_.patches, 0);
    for (std::size_t t = 0; t < cut_.source.size(); ++t) is_wanted[parts_.patch_of[t]] |= char{cut_.source[t] >= first};
    parallel_for(parts_.patches, 1, threads_, [&](std::size_t patch) {
      if (is_wanted[patch] == 0) return;
      std::vector<std::uint32_t>& samples = positions[patch];
      const auto area_at = [&](std::uint32_t position) { return area(tree.corners[position]); };
      std::ranges::sort(samples, std::greater<>(), area_at);
      const double least = kThin * area_at(samples.front());
      if (is_closed && samples.size() > kSamples) samples.resize(kSamples);
      is_inner_[patch] = std::ranges::all_of(samples, [&](std::uint32_t position) {
        return area_at(position) < least || lies_inside(position, is_closed, tree, winding, change);
      });
    });
    fields_.clear();
    for (std::size_t t = 0; t < cut_.uncut.size(); ++t) {
      if (cut_.uncut[t]) is_inner_[parts_.patch_of[t]] = 0;
    }
  }

  /// Of the triangle at a position of the tree. The triangles around it for which the same follows are covered.
  bool lies_inside(std::uint32_t position, bool is_closed, const TriangleTree& tree, const WindingTree& winding,
                   const WindingChange& change) {
    const std::uint32_t t = tree.order[position];
    if (is_covered_[t]) return true;
    const auto margin_at = [&](const Point& p) { return margin(t, p, winding.beside(position, p)); };
    const std::array<Point, 4> points = points_of(tree.corners[position]);
    const double at_centroid = margin_at(points[0]);
    if (at_centroid < 0 || is_closed) return at_centroid >= 0;
    if (const double radius = change.radius(points[0], at_centroid, farthest_corner(t, points[0])); radius > 0) {
      visit_neighbours(mesh_, topology_, t, points[0], radius,
                       [&](std::uint32_t other) { return std::exchange(is_covered_[other], 1) == 0; });
      return true;
    }
    return std::all_of(points.begin() + 1, points.end(), [&](const Point& p) { return margin_at(p) >= 0; });
  }

  /// By how much the winding numbers may change while a point of the triangle lies inside; negative if it does not.
  /// `beside`: the winding number beside it. That of the other components changes by that of two fields.
  double margin(std::uint32_t t, const Point& p, double beside) const {
    if (beside >= kInside || beside < kInsideOthers) return beside - kInside;
    return (std::min(beside, beside - fields_[component(t)]->beside(number_of_[t], p)) - kInsideOthers) / 2;
  }

  double farthest_corner(std::uint32_t t, const Point& p) const {
    double farthest = 0;
    for (const std::uint32_t v : mesh_.triangles[t]) farthest = std::max(farthest, length(mesh_.vertices[v] - p));
    return farthest;
  }

  /// True if all triangles cancel at every edge.
  bool balance_everywhere() const {
    for (std::uint32_t edge = 0; edge < topology_.edge_count(); ++edge) {
      if (balance_at(mesh_, topology_, edge) != 0) return false;
    }
    return true;
  }

  /// 1 or -1, by the direction in which the triangle runs along the edge.
  int step_along(std::uint32_t edge, std::uint32_t t) const {
    return runs_upwards(mesh_.triangles[t], topology_.ends(edge)) ? 1 : -1;
  }

  std::uint32_t component(std::uint32_t t) const { return component_of_[cut_.source[t]]; }

  void find_component_fields() {
    std::vector<std::vector<std::uint32_t>> members;
    number_of_.resize(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      members.resize(std::max<std::size_t>(members.size(), component(t) + 1));
      number_of_[t] = static_cast<std::uint32_t>(members[component(t)].size());
      members[component(t)].push_back(t);
    }
    fields_.resize(members.size());
    parallel_for(members.size(), 1, threads_, [&](std::size_t i) {
      if (!members[i].empty()) fields_[i] = std::make_unique<ComponentField>(mesh_, members[i]);
    });
  }

  /// Restores the inner patches at each edge of the boundary that would lose its balance without them. Edges between
  /// inner patches lie inside, where a wall that ends does no harm.
  void restore_openings() {
    const std::vector<char> were_inner = is_inner_;
    for (std::uint32_t edge = 0; edge < topology_.edge_count(); ++edge) {
      int before = 0, after = 0;
      std::size_t inner = 0;
      const auto beside = topology_.triangles_of(edge);
      for (const std::uint32_t t : beside) {
        const int step = step_along(edge, t);
        before += step;
        const bool is_inner = were_inner[parts_.patch_of[t]] != 0;
        inner += is_inner;
        if (!is_inner) after += step;
      }
      if (inner == 0 || inner == beside.size() || std::abs(after) <= std::abs(before)) continue;
      for (const std::uint32_t t : beside) is_inner_[parts_.patch_of[t]] = 0;
    }
  }

  const std::vector<std::uint32_t>& component_of_;  // by triangle before the cut
  CutMesh cut_;
  Mesh mesh_;
  MeshTopology topology_;
  SurfaceParts parts_;
  unsigned threads_;
  std::vector<char> is_inner_;    // by patch
  std::vector<char> is_covered_;  // by triangle: it lies inside as a neighbour does
  std::vector<std::unique_ptr<ComponentField>> fields_;
  std::vector<std::uint32_t> number_of_;  // by triangle: its number in its component
};

}  // namespace

std::vector<char> lie_inside(CutMesh cut, const std::vector<std::uint32_t>& component_of, std::size_t first,
                             unsigned threads) {
  return BoundaryFinder(std::move(cut), component_of, threads).lie_inside(first);
}

OuterBoundary leave_out_inner_patches(CutMesh cut, const std::vector<std::uint32_t>& component_of, unsigned threads) {
  return BoundaryFinder(std::move(cut), component_of, threads).run();
}

}  // namespace medial_vk
