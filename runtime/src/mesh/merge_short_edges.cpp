#include "mesh/merge_short_edges.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/point_ops.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kRemoved = 0xffffffffu;

struct ShortEdge {
  double length;
  std::uint32_t a, b;

  auto key() const { return std::tuple(length, a, b); }
};

class EdgeMerger {
 public:
  EdgeMerger(Mesh& mesh, std::size_t first_new, double length)
      : mesh_(mesh), first_new_(first_new), length_(length), around_(mesh), is_gone_(mesh.triangles.size(), false) {}

  /// By triangle: whether it has vanished.
  const std::vector<bool>& run() {
    std::vector<ShortEdge> edges = short_edges();
    // An edge that has to stay may be merged when its neighbours are gone.
    while (std::erase_if(edges, [&](const ShortEdge& e) { return merge(survivor(e.a), survivor(e.b)); }) > 0) {
    }
    return is_gone_;
  }

 private:
  bool is_short(std::uint32_t a, std::uint32_t b) const {
    return length(mesh_.vertices[b] - mesh_.vertices[a]) < length_;
  }

  std::vector<ShortEdge> short_edges() const {
    std::vector<ShortEdge> edges;
    for (const Triangle& t : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
        if (b >= first_new_ && is_short(a, b)) edges.push_back({length(mesh_.vertices[b] - mesh_.vertices[a]), a, b});
      }
    }
    std::ranges::sort(edges, {}, &ShortEdge::key);
    const auto is_same = [](const ShortEdge& e, const ShortEdge& f) { return e.key() == f.key(); };
    edges.erase(std::unique(edges.begin(), edges.end(), is_same), edges.end());
    return edges;
  }

  std::uint32_t survivor(std::uint32_t v) const {
    for (auto merged = merged_into_.find(v); merged != merged_into_.end(); merged = merged_into_.find(v))
      v = merged->second;
    return v;
  }

  /// True if the edge is gone. The smaller number stays: vertices of the mesh come before those on crossings.
  bool merge(std::uint32_t a, std::uint32_t b) {
    if (a == b) return true;
    const std::uint32_t stays = std::min(a, b), moves = std::max(a, b);
    if (moves < first_new_ || !is_short(a, b)) return true;
    // Of those that have been merged into it, too.
    const double way = way_of(moves) + length(mesh_.vertices[stays] - mesh_.vertices[moves]);
    if (way > length_) return true;
    const std::vector<std::uint32_t> moved = triangles_of(moves);
    if (!touches_only_at_the_edge(stays, moves) || turns_over(moved, stays, moves)) return false;
    way_[stays] = std::max(way_of(stays), way);
    std::vector<std::uint32_t> joined = triangles_of(stays);
    for (const std::uint32_t t : moved) {
      if (has(t, stays)) {
        is_gone_[t] = true;
        continue;
      }
      std::ranges::replace(mesh_.triangles[t], moves, stays);
      joined.push_back(t);
    }
    std::erase_if(joined, [&](std::uint32_t t) { return is_gone_[t]; });
    joined_[stays] = std::move(joined);
    merged_into_[moves] = stays;
    return true;
  }

  double way_of(std::uint32_t v) const {
    const auto known = way_.find(v);
    return known != way_.end() ? known->second : 0;
  }

  bool has(std::uint32_t t, std::uint32_t v) const {
    return std::ranges::find(mesh_.triangles[t], v) != mesh_.triangles[t].end();
  }

  std::vector<std::uint32_t> triangles_of(std::uint32_t v) const {
    const auto joined = joined_.find(v);
    const std::span<const std::uint32_t> all = joined != joined_.end() ? joined->second : around_.of(v);
    std::vector<std::uint32_t> there;
    std::ranges::copy_if(all, std::back_inserter(there), [&](std::uint32_t t) { return !is_gone_[t]; });
    return there;
  }

  /// The link condition: every common neighbour of the two is the third corner of a triangle at their edge, of which
  /// there must be one, and no two triangles become one, as those of a tetrahedron would.
  bool touches_only_at_the_edge(std::uint32_t stays, std::uint32_t moves) const {
    std::vector<std::uint32_t> thirds, near_one, near_other, common;
    for (const auto& [v, neighbours] : {std::pair{stays, &near_one}, std::pair{moves, &near_other}}) {
      for (const std::uint32_t t : triangles_of(v)) {
        const bool is_at_edge = has(t, stays) && has(t, moves);
        for (const std::uint32_t corner : mesh_.triangles[t]) {
          if (corner == stays || corner == moves) continue;
          neighbours->push_back(corner);
          if (is_at_edge) thirds.push_back(corner);
        }
      }
    }
    for (std::vector<std::uint32_t>* set : {&thirds, &near_one, &near_other}) {
      std::ranges::sort(*set);
      set->erase(std::unique(set->begin(), set->end()), set->end());
    }
    std::ranges::set_intersection(near_one, near_other, std::back_inserter(common));
    return !thirds.empty() && common == thirds && !coincides(stays, moves);
  }

  /// True if a triangle of one has the same two other corners as one of the other.
  bool coincides(std::uint32_t stays, std::uint32_t moves) const {
    const auto opposite = [&](std::uint32_t t, std::uint32_t v) {
      Triangle corners = mesh_.triangles[t];
      std::ranges::replace(corners, v, kRemoved);
      std::ranges::sort(corners);
      return corners;
    };
    const std::vector<std::uint32_t> others = triangles_of(stays);
    for (const std::uint32_t t : triangles_of(moves)) {
      if (has(t, stays)) continue;
      const Triangle side = opposite(t, moves);
      if (std::ranges::any_of(others, [&](std::uint32_t u) { return !has(u, moves) && opposite(u, stays) == side; }))
        return true;
    }
    return false;
  }

  /// Triangles with a short edge are not examined: slivers have no reliable normal.
  bool turns_over(const std::vector<std::uint32_t>& moved, std::uint32_t stays, std::uint32_t moves) const {
    return std::ranges::any_of(moved, [&](std::uint32_t t) {
      Triangle corners = mesh_.triangles[t];
      if (has(t, stays) || is_short(corners[0], corners[1]) || is_short(corners[1], corners[2]) ||
          is_short(corners[2], corners[0]))
        return false;
      const Point before = area(corners);
      std::ranges::replace(corners, moves, stays);
      return !(dot(before, area(corners)) > 0);
    });
  }

  Point area(const Triangle& t) const {
    const Point& origin = mesh_.vertices[t[0]];
    return cross(mesh_.vertices[t[1]] - origin, mesh_.vertices[t[2]] - origin);
  }

  Mesh& mesh_;
  const std::size_t first_new_;
  const double length_;
  const VertexTriangles around_;                                          // before any merge
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> joined_;  // of vertices that others were merged into
  std::unordered_map<std::uint32_t, std::uint32_t> merged_into_;
  std::unordered_map<std::uint32_t, double> way_;  // by survivor: the farthest that a vertex has moved onto it
  std::vector<bool> is_gone_;
};

}  // namespace

void merge_short_edges(Mesh& mesh, std::vector<std::uint32_t>& source, std::size_t first_new, double length) {
  if (mesh.vertices.size() <= first_new) return;
  EdgeMerger merger(mesh, first_new, length);
  const std::vector<bool>& is_gone = merger.run();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_gone[t]) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    source[kept++] = source[t];
  }
  mesh.triangles.resize(kept);
  source.resize(kept);
}

}  // namespace medial_vk
