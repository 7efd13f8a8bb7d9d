#include "mesh/outer_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/crossings/cut_crossings.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"
#include "mesh/winding_number.h"

namespace medial_vk {
namespace {

/// A patch lies inside if the winding number without itself is at least this beside every sample of it: 1/2 behind and
/// in front, and a margin above the error of WindingTree.
constexpr double kInside = 1.05;
/// Or if it and that of the other components are at least this: 1/2, and a margin for two values. It is lower than 1
/// only where its own component is open; beside the wall of a cavity it is 1/2.
constexpr double kInsideOthers = 0.6;

/// The largest triangles of a patch are its samples: they are the farthest from others. Where all parts are closed, a
/// patch has one value; where some are open, values vary slowly.
constexpr std::size_t kSamples = 64;

double area(const std::array<Point, 3>& corners) {
  return length(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
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

  /// Beside its triangle with this number, without that triangle.
  double beside(std::uint32_t number) const { return winding_.beside(position_of_[number]); }

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

  OuterBoundary run() {
    find_inner_patches();
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
  void find_inner_patches() {
    std::swap(mesh_.vertices, cut_.decided);
    const TriangleTree tree(mesh_);
    const WindingTree winding(tree);
    find_component_fields();
    std::swap(mesh_.vertices, cut_.decided);
    std::vector<std::vector<std::uint32_t>> positions(parts_.patches);  // in the tree
    for (std::uint32_t position = 0; position < tree.order.size(); ++position)
      positions[parts_.patch_of[tree.order[position]]].push_back(position);
    is_inner_.assign(parts_.patches, 0);
    parallel_for(parts_.patches, 1, threads_, [&](std::size_t patch) {
      std::vector<std::uint32_t>& samples = positions[patch];
      const auto end = samples.begin() + static_cast<std::ptrdiff_t>(std::min(samples.size(), kSamples));
      std::ranges::partial_sort(samples, end, std::greater<>(),
                                [&](std::uint32_t position) { return area(tree.corners[position]); });
      is_inner_[patch] = std::all_of(samples.begin(), end, [&](std::uint32_t position) {
        const std::uint32_t t = tree.order[position];
        const double beside = winding.beside(position);
        if (beside >= kInside || beside < kInsideOthers) return beside >= kInside;
        return beside - fields_[component(t)]->beside(number_of_[t]) >= kInsideOthers;
      });
    });
    fields_.clear();
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
        const int step = runs_upwards(mesh_.triangles[t], topology_.ends(edge)) ? 1 : -1;
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
  std::vector<char> is_inner_;  // by patch
  std::vector<std::unique_ptr<ComponentField>> fields_;
  std::vector<std::uint32_t> number_of_;  // by triangle: its number in its component
};

}  // namespace

OuterBoundary find_outer_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const TriangleTree& tree, const SelfIntersections& intersections, unsigned threads) {
  return BoundaryFinder(cut_crossings(mesh, tree, intersections, threads), component_of, threads).run();
}

}  // namespace medial_vk
