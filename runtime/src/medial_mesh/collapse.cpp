#include "medial_mesh/collapse.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <queue>
#include <utility>

#include "base/disjoint_sets.h"
#include "medial_mesh/surface_complex.h"

namespace medial_vk {
namespace {

/// By triangle: the tetrahedra at it, where the number of tetrahedra denotes the outside.
std::vector<std::array<std::uint32_t, 2>> tetrahedra_at_triangles(const DualComplex& complex) {
  const auto outside = static_cast<std::uint32_t>(complex.tetrahedra.size());
  std::vector<std::array<std::uint32_t, 2>> at(complex.triangles.size(), {outside, outside});
  for (std::uint32_t n = 0; n < outside; ++n) {
    const auto& [a, b, c, d] = complex.tetrahedra[n];
    for (const std::array<std::uint32_t, 3>& face : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) {
      const auto found = std::lower_bound(complex.triangles.begin(), complex.triangles.end(), face);
      std::array<std::uint32_t, 2>& two = at[static_cast<std::size_t>(found - complex.triangles.begin())];
      two[two[0] == outside ? 0 : 1] = n;
    }
  }
  return at;
}

/// Each tetrahedron collapses with one of its faces: from outside in, along a tree that joins all tetrahedra and the
/// outside by faces, the face towards the outside is in no other tetrahedron in its turn. The tree of the largest faces
/// (Kruskal 1956) leaves the smallest faces that any collapse of all tetrahedra can leave.
std::vector<bool> faces_that_go(const DualComplex& complex, const CollapseRule& rule) {
  std::vector<double> sizes;
  sizes.reserve(complex.triangles.size());
  for (const auto& [a, b, c] : complex.triangles) {
    sizes.push_back(rule.squared_length(a, b) + rule.squared_length(a, c) + rule.squared_length(b, c));
  }
  std::vector<std::uint32_t> order(complex.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t s, std::uint32_t t) {
    if (sizes[s] != sizes[t]) return sizes[s] > sizes[t];
    return s < t;
  });
  const std::vector<std::array<std::uint32_t, 2>> at = tetrahedra_at_triangles(complex);
  DisjointSets sets(complex.tetrahedra.size() + 1);
  std::vector<bool> gone(complex.triangles.size());
  for (const std::uint32_t t : order) gone[t] = at[t][0] != at[t][1] && sets.join(at[t][0], at[t][1]);
  return gone;
}

class Trimming {
 public:
  Trimming(const DualComplex& complex, const CollapseRule& rule, SurfaceComplex& surface)
      : complex_(complex), rule_(rule), surface_(surface) {}

  /// Collapses triangles at the border from edges that are too long to end a sheet, the longest first.
  void take_long_edges() {
    std::priority_queue<Turn> turns;
    for (const std::uint32_t e : surface_.free_edges()) turns.push(turn(e));
    while (!turns.empty()) {
      const std::uint32_t edge = ~turns.top().second;
      turns.pop();
      const auto& [a, b] = complex_.edges[edge];
      if (surface_.count(edge) != 1 || rule_.close(a, b)) continue;
      const std::array<std::uint32_t, 3> sides = surface_.sides(surface_.triangle_at(edge));
      surface_.collapse(edge);
      for (const std::uint32_t side : sides) {
        if (surface_.count(side) == 1) turns.push(turn(side));
      }
    }
  }

  /// Small ones first: the support of a fin is often a fin after that one has collapsed.
  void take_fins() {
    for (std::size_t limit = 1; limit <= complex_.triangles.size();) limit = take_fins(limit) ? 1 : 2 * limit;
  }

 private:
  using Turn = std::pair<double, std::uint32_t>;  // of equal lengths, the first edge comes first

  Turn turn(std::uint32_t edge) const {
    const auto& [a, b] = complex_.edges[edge];
    return {rule_.squared_length(a, b), ~edge};
  }

  /// Those of at most `limit` triangles. False: there was none.
  bool take_fins(std::size_t limit) {
    std::vector<Turn> turns;
    for (const std::uint32_t e : surface_.free_edges()) turns.push_back(turn(e));
    std::sort(turns.rbegin(), turns.rend());
    bool taken = false;
    for (const auto& [length, inverse] : turns) {
      if (surface_.count(~inverse) != 1 || !find_fin(~inverse, limit)) continue;
      for (const std::uint32_t edge : fin_) surface_.collapse(edge);
      taken = true;
    }
    return taken;
  }

  /// A fin is the set of triangles reached from a free edge across edges of two triangles, if it is a tree that has no
  /// other free edge: one edge collapses with each triangle, and every vertex is on an edge of three triangles or more
  /// that bears the fin. Fills in the edges, each of which is free when those before it have collapsed.
  bool find_fin(std::uint32_t free_edge, std::size_t limit) {
    fin_.assign(1, free_edge);
    triangles_.assign(1, surface_.triangle_at(free_edge));
    for (std::size_t n = 0; n < fin_.size(); ++n) {
      if (n == limit) return false;
      for (const std::uint32_t side : surface_.sides(triangles_[n])) {
        if (side == fin_[n] || surface_.count(side) > 2) continue;
        if (surface_.count(side) == 1) return false;
        const std::uint32_t beyond = surface_.triangle_at(side, triangles_[n]);
        if (std::find(triangles_.begin(), triangles_.end(), beyond) != triangles_.end()) return false;
        fin_.push_back(side);
        triangles_.push_back(beyond);
      }
    }
    return true;
  }

  const DualComplex& complex_;
  const CollapseRule& rule_;
  SurfaceComplex& surface_;
  std::vector<std::uint32_t> fin_, triangles_;  // the edge, and the triangle that collapses with it
};

}  // namespace

DualComplex collapse_to_surface(const DualComplex& complex, const CollapseRule& rule) {
  SurfaceComplex surface(complex, faces_that_go(complex, rule));
  Trimming trimming(complex, rule, surface);
  trimming.take_long_edges();
  trimming.take_fins();
  DualComplex out;
  out.vertices = complex.vertices;
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    if (surface.has_edge(e)) out.edges.push_back(complex.edges[e]);
  }
  for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
    if (surface.has_triangle(t)) out.triangles.push_back(complex.triangles[t]);
  }
  return out;
}

}  // namespace medial_vk
