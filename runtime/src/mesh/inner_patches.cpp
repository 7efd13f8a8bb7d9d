#include "mesh/inner_patches.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"
#include "mesh/winding/part_field.h"
#include "mesh/winding_change.h"

namespace medial_vk {
namespace {

/// A patch lies inside if the winding number without itself is at least this beside every sample of it: 1/2 behind and
/// in front, and a margin above the error of WindingTree.
constexpr double kWithin = 1.05;
/// Or if it and that of the other components are at least this: 1/2, and a margin for two values. It is lower than 1
/// only where its own component is open; beside the wall of a cavity it is 1/2.
constexpr double kWithinOthers = 0.6;

/// Where all components are closed, a patch has one value, and its largest triangles are evaluated, which are the
/// farthest from others. Where some are open, all triangles are, near their corners, too, but for those so thin that
/// rounding decides their value.
constexpr std::size_t kSamples = 64;
constexpr double kThin = 0x1p-30;  // of the area of the largest triangle of the patch

std::array<Point, 3> corners_of(const Mesh& mesh, std::uint32_t t) {
  const Triangle& corners = mesh.triangles[t];
  return {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]};
}

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

enum class Place : std::uint8_t { kBoundary, kInside, kOutside };

class BoundaryFinder {
 public:
  BoundaryFinder(CutMesh cut, const CutComponents& components, unsigned threads)
      : components_(components),
        cut_(std::move(cut)),
        mesh_{std::move(cut_.vertices), std::move(cut_.triangles), 0, 0},
        topology_(mesh_),
        parts_(find_parts(mesh_, topology_)),
        threads_(threads) {}

  /// By triangle of the cut: 1 if its patch lies inside and has a triangle from this one of the mesh on.
  std::vector<char> lie_inside(std::size_t first) {
    place_patches(first);
    std::vector<char> inside;
    for (const std::uint32_t patch : parts_.patch_of) inside.push_back(place_[patch] == Place::kInside ? 1 : 0);
    return inside;
  }

  OuterBoundary run() {
    place_patches(0);
    restore_openings();
    OuterBoundary out;
    out.mesh.vertices = std::move(mesh_.vertices);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Place place = place_[parts_.patch_of[t]];
      out.inner_triangles += place == Place::kInside;
      out.outer_triangles += place == Place::kOutside;
      if (place != Place::kBoundary) continue;
      out.mesh.triangles.push_back(mesh_.triangles[t]);
      out.source.push_back(cut_.source[t]);
    }
    out.cut_triangles = cut_.cut_triangles;
    return out;
  }

 private:
  /// Of those that have a triangle from this one of the mesh on.
  void place_patches(std::size_t first) {
    is_closed_ = balance_everywhere();
    std::swap(mesh_.vertices, cut_.decided);
    find_fields();
    const Mesh decided = mesh_;
    std::swap(mesh_.vertices, cut_.decided);
    std::vector<std::vector<std::uint32_t>> members(parts_.patches);
    std::vector<char> is_wanted(parts_.patches, 0);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      members[parts_.patch_of[t]].push_back(t);
      is_wanted[parts_.patch_of[t]] |= char{cut_.source[t] >= first};
    }
    const WindingChange change(mesh_, topology_);
    place_.assign(parts_.patches, Place::kBoundary);
    covered_.assign(mesh_.triangles.size(), Place::kBoundary);
    parallel_for(parts_.patches, 1, threads_, [&](std::size_t patch) {
      if (is_wanted[patch] != 0) place_[patch] = place_of(std::move(members[patch]), decided, change);
    });
    solid_field_.reset();
    fields_.clear();
    for (std::size_t t = 0; t < cut_.uncut.size(); ++t) {
      if (cut_.uncut[t]) place_[parts_.patch_of[t]] = Place::kBoundary;
    }
  }

  /// Of a patch with these triangles.
  Place place_of(std::vector<std::uint32_t> triangles, const Mesh& decided, const WindingChange& change) {
    const auto area_of = [&](std::uint32_t t) { return area(corners_of(decided, t)); };
    std::ranges::sort(triangles, [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(-area_of(a), a) < std::pair(-area_of(b), b);
    });
    const double least = kThin * area_of(triangles.front());
    if (is_closed_ && triangles.size() > kSamples) triangles.resize(kSamples);
    const auto all_lie = [&](Place place) {
      return std::ranges::all_of(triangles, [&](std::uint32_t t) {
        return area_of(t) < least || lies(place, t, corners_of(decided, t), change);
      });
    };
    if (all_lie(Place::kInside)) return Place::kInside;
    const bool may_go = is_membrane(triangles.front()) && !components_.keep_outer;
    return may_go && all_lie(Place::kOutside) ? Place::kOutside : Place::kBoundary;
  }

  /// Of a triangle. The triangles around it for which the same follows are covered.
  bool lies(Place place, std::uint32_t t, const std::array<Point, 3>& corners, const WindingChange& change) {
    if (covered_[t] == place) return true;
    const std::array<Point, 4> points = points_of(corners);
    const double at_centroid = margin(place, t, points[0]);
    if (at_centroid < 0 || is_closed_) return at_centroid >= 0;
    if (const double radius = change.radius(points[0], at_centroid, farthest_corner(t, points[0])); radius > 0) {
      visit_neighbours(mesh_, topology_, t, points[0], radius,
                       [&](std::uint32_t other) { return std::exchange(covered_[other], place) != place; });
      return true;
    }
    return std::all_of(points.begin() + 1, points.end(), [&](const Point& p) { return margin(place, t, p) >= 0; });
  }

  /// By how much the winding numbers may change while a point of the triangle lies there; negative if it does not. The
  /// difference of two winding numbers changes by that of both.
  double margin(Place place, std::uint32_t t, const Point& p) const {
    if (place == Place::kOutside) return 1 - kWithinOthers - solid_field_->at(p);
    if (is_membrane(t)) return solid_field_->at(p) - kWithinOthers;
    const double beside = solid_field_->beside(number_in_solid_[t], p);
    if (beside >= kWithin || beside < kWithinOthers || is_closed_) return beside - kWithin;
    return (std::min(beside, beside - fields_[component(t)]->beside(number_of_[t], p)) - kWithinOthers) / 2;
  }

  double farthest_corner(std::uint32_t t, const Point& p) const {
    double farthest = 0;
    for (const std::uint32_t v : mesh_.triangles[t]) farthest = std::max(farthest, length(mesh_.vertices[v] - p));
    return farthest;
  }

  /// True if all triangles, without membranes, cancel at every edge.
  bool balance_everywhere() const {
    for (std::uint32_t edge = 0; edge < topology_.edge_count(); ++edge) {
      int balance = 0;
      for (const std::uint32_t t : topology_.triangles_of(edge)) balance += is_membrane(t) ? 0 : step_along(edge, t);
      if (balance != 0) return false;
    }
    return true;
  }

  /// 1 or -1, by the direction in which the triangle runs along the edge.
  int step_along(std::uint32_t edge, std::uint32_t t) const {
    return runs_upwards(mesh_.triangles[t], topology_.ends(edge)) ? 1 : -1;
  }

  std::uint32_t component(std::uint32_t t) const { return components_.of_triangle[cut_.source[t]]; }
  bool is_membrane(std::uint32_t t) const {
    return !components_.is_membrane.empty() && components_.is_membrane[component(t)] != 0;
  }

  /// The winding numbers of all triangles without membranes, and, where the mesh is open, of each component.
  void find_fields() {
    std::vector<std::uint32_t> solid;
    std::vector<std::vector<std::uint32_t>> members;
    number_in_solid_.resize(mesh_.triangles.size());
    number_of_.resize(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_membrane(t)) continue;
      number_in_solid_[t] = static_cast<std::uint32_t>(solid.size());
      solid.push_back(t);
      members.resize(std::max<std::size_t>(members.size(), component(t) + 1));
      number_of_[t] = static_cast<std::uint32_t>(members[component(t)].size());
      members[component(t)].push_back(t);
    }
    solid_field_ = std::make_unique<PartField>(mesh_, solid);
    if (is_closed_) return;
    fields_.resize(members.size());
    parallel_for(members.size(), 1, threads_, [&](std::size_t i) {
      if (!members[i].empty()) fields_[i] = std::make_unique<PartField>(mesh_, members[i]);
    });
  }

  /// Restores the inner patches at each edge of the boundary that would lose its balance without them. Edges between
  /// inner patches lie inside, where a wall that ends does no harm.
  void restore_openings() {
    const std::vector<Place> found = place_;
    for (std::uint32_t edge = 0; edge < topology_.edge_count(); ++edge) {
      int before = 0, after = 0;
      std::size_t inner = 0, all = 0;
      const auto beside = topology_.triangles_of(edge);
      for (const std::uint32_t t : beside) {
        if (is_membrane(t)) continue;
        ++all;
        before += step_along(edge, t);
        const bool is_inner = found[parts_.patch_of[t]] == Place::kInside;
        inner += is_inner;
        if (!is_inner) after += step_along(edge, t);
      }
      if (inner == 0 || inner == all || std::abs(after) <= std::abs(before)) continue;
      for (const std::uint32_t t : beside) {
        if (!is_membrane(t)) place_[parts_.patch_of[t]] = Place::kBoundary;
      }
    }
  }

  const CutComponents& components_;
  CutMesh cut_;
  Mesh mesh_;
  MeshTopology topology_;
  SurfaceParts parts_;
  unsigned threads_;
  bool is_closed_ = false;      // without membranes
  std::vector<Place> place_;    // by patch
  std::vector<Place> covered_;  // by triangle: it lies there as a neighbour does
  std::unique_ptr<PartField> solid_field_;
  std::vector<std::unique_ptr<PartField>> fields_;  // by component
  // By triangle: its number in these fields.
  std::vector<std::uint32_t> number_in_solid_, number_of_;
};

}  // namespace

std::vector<char> lie_inside(CutMesh cut, const CutComponents& components, std::size_t first, unsigned threads) {
  return BoundaryFinder(std::move(cut), components, threads).lie_inside(first);
}

OuterBoundary leave_out_inner_patches(CutMesh cut, const CutComponents& components, unsigned threads) {
  return BoundaryFinder(std::move(cut), components, threads).run();
}

}  // namespace medial_vk
