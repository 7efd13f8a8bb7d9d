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
    const auto repeated = std::ranges::unique(edges, {}, &ShortEdge::key);
    edges.erase(repeated.begin(), repeated.end());
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
    const std::vector<std::uint32_t> moved = triangles_of(moves);
    if (!touches_only_at_the_edge(stays, moves) || turns_over(moved, stays, moves)) return false;
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

  /// The link condition: every common neighbour of the two is the third corner of a triangle at their edge. There must
  /// be such a triangle.
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
      set->erase(std::ranges::unique(*set).begin(), set->end());
    }
    std::ranges::set_intersection(near_one, near_other, std::back_inserter(common));
    return !thirds.empty() && common == thirds;
  }

  /// Of triangles with a short edge, which vanish next, the normal says nothing.
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
