#include "mesh/crossings/crossing_segments.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/crossings/self_intersections.h"

namespace medial_vk {
namespace {

using Pair = std::array<std::uint32_t, 2>;
using Edge = std::array<std::uint32_t, 2>;

/// Two triangles that cross, and the ends of their segment: an edge and the triangle that it crosses, or a shared
/// vertex.
struct CrossingPair {
  struct End {
    Edge edge;               // the smaller vertex first; twice the same: a shared vertex
    std::uint32_t triangle;  // of the two
  };
  Pair triangles;
  std::array<End, 2> ends;
};

enum class Outcome { kApart, kCrosses, kDegenerate };

/// Classifies pairs of triangles. For one thread.
class PairTest {
 public:
  PairTest(const Mesh& mesh, const std::vector<Point>& grid) : mesh_(mesh), grid_(grid) {}

  Outcome test(std::uint32_t t, std::uint32_t u, CrossingPair& out) {
    const std::optional<std::uint32_t> shared = shared_vertex(t, u);
    if (shared_ > 1) return Outcome::kApart;  // a fold onto a neighbour is not cut
    out.triangles = {t, u};
    ends_ = 0;
    for (const auto& [edges_of, plane_of] : {Pair{u, t}, Pair{t, u}}) {
      const Outcome outcome = test_edges(edges_of, plane_of, shared, out);
      if (outcome != Outcome::kCrosses) return outcome;
    }
    if (ends_ == 0) return Outcome::kApart;
    if (shared) {
      if (ends_ != 1) return Outcome::kDegenerate;
      out.ends[1] = {{*shared, *shared}, t};
      return Outcome::kCrosses;
    }
    return ends_ == 2 ? Outcome::kCrosses : Outcome::kDegenerate;
  }

 private:
  std::optional<std::uint32_t> shared_vertex(std::uint32_t t, std::uint32_t u) {
    std::optional<std::uint32_t> shared;
    shared_ = 0;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (std::ranges::find(mesh_.triangles[u], v) == mesh_.triangles[u].end()) continue;
      shared = v;
      ++shared_;
    }
    return shared;
  }

  /// The edges of one triangle against the other. kCrosses: not decided yet.
  Outcome test_edges(std::uint32_t of, std::uint32_t plane, std::optional<std::uint32_t> shared, CrossingPair& out) {
    const Triangle& corners = mesh_.triangles[of];
    std::array<int, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = shared == corners[k] ? 0 : side_of(plane, corners[k]);
      if (sides[k] == 0 && shared != corners[k]) return Outcome::kDegenerate;
    }
    if (std::ranges::none_of(sides, [](int s) { return s > 0; }) ||
        std::ranges::none_of(sides, [](int s) { return s < 0; }))
      return Outcome::kApart;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      if (sides[k] * sides[l] >= 0) continue;
      const Edge edge = {std::min(corners[k], corners[l]), std::max(corners[k], corners[l])};
      const std::optional<bool> passes = passes_through(edge, plane);
      if (!passes) return Outcome::kDegenerate;
      if (!*passes) continue;
      if (ends_ == 2) return Outcome::kDegenerate;
      out.ends[ends_++] = {edge, plane};
    }
    return Outcome::kCrosses;
  }

  int side_of(std::uint32_t plane, std::uint32_t vertex) {
    const Triangle& t = mesh_.triangles[plane];
    return geometry_.side(grid_[t[0]], grid_[t[1]], grid_[t[2]], grid_[vertex]);
  }

  /// Whether the line through an edge passes through a triangle; no value if it meets the triangle's boundary.
  std::optional<bool> passes_through(const Edge& edge, std::uint32_t triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    int first = 0;
    bool passes = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const int turn = geometry_.side(grid_[edge[0]], grid_[edge[1]], grid_[t[k]], grid_[t[(k + 1) % 3]]);
      if (turn == 0) return std::nullopt;
      if (k == 0) first = turn;
      passes = passes && turn == first;
    }
    return passes;
  }

  const Mesh& mesh_;
  const std::vector<Point>& grid_;
  ExactGeometry geometry_;
  std::size_t ends_ = 0;
  int shared_ = 0;
};

/// Calls visit(j) with the later positions in the tree whose boxes overlap that of position i, grown by `reach`.
template <class Visit>
void for_each_later(const TriangleTree& tree, std::uint32_t i, double reach, std::vector<std::uint32_t>& stack,
                    Visit visit) {
  const Point margin = {reach, reach, reach};
  const TreeBox box = {tree.boxes[i].lower - margin, tree.boxes[i].upper + margin};
  stack.assign(1, 0);
  while (!stack.empty()) {
    const TriangleTree::Node& node = tree.nodes[stack.back()];
    stack.pop_back();
    if (node.first + node.count <= i + 1 || !overlap(node.box, box)) continue;
    if (node.left != 0) {
      stack.insert(stack.end(), {node.left, node.right});
      continue;
    }
    for (std::uint32_t j = std::max(node.first, i + 1); j < node.first + node.count; ++j) {
      if (overlap(box, tree.boxes[j])) visit(j);
    }
  }
}

class CrossingFinder {
 public:
  CrossingFinder(const Mesh& mesh, const GridPositions& grid, const TriangleTree& tree,
                 const std::vector<bool>& crossed, unsigned threads)
      : mesh_(mesh), grid_(grid.of_vertex), moved_(grid.moved), tree_(tree), crossed_(crossed), threads_(threads) {
    out_.segments.resize(mesh.triangles.size());
    out_.inside.resize(mesh.triangles.size());
  }

  std::optional<Crossings> run() {
    if (!find_pairs()) return std::nullopt;
    for (const CrossingPair& pair : pairs_) add(pair);
    if (!find_triple_points()) return std::nullopt;
    return std::move(out_);
  }

 private:
  bool find_pairs() {
    constexpr std::size_t kBlock = 256;
    const std::size_t blocks = (tree_.order.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<CrossingPair>> found(blocks);
    std::vector<char> degenerate(blocks, 0);
    parallel_for(blocks, 1, threads_, [&](std::size_t b) {
      PairTest test(mesh_, grid_);
      std::vector<std::uint32_t> stack;
      const auto end = static_cast<std::uint32_t>(std::min((b + 1) * kBlock, tree_.order.size()));
      for (auto i = static_cast<std::uint32_t>(b * kBlock); i < end; ++i) {
        const std::uint32_t t = tree_.order[i];
        if (moved_ == 0 && !crossed_[t]) continue;
        for_each_later(tree_, i, 2 * moved_, stack, [&](std::uint32_t j) {
          const std::uint32_t u = tree_.order[j];
          if (moved_ == 0 && (!crossed_[u] || certainly_apart(mesh_, tree_, i, j))) return;
          CrossingPair pair;
          const Outcome outcome = test.test(std::min(t, u), std::max(t, u), pair);
          if (outcome == Outcome::kCrosses) found[b].push_back(pair);
          if (outcome == Outcome::kDegenerate) degenerate[b] = 1;
        });
      }
    });
    for (const auto& list : found) pairs_.insert(pairs_.end(), list.begin(), list.end());
    std::ranges::sort(pairs_, {}, &CrossingPair::triangles);
    return std::ranges::none_of(degenerate, [](char d) { return d != 0; });
  }

  void add(const CrossingPair& pair) {
    std::array<std::uint32_t, 2> points;
    for (std::size_t k = 0; k < 2; ++k) points[k] = point_of(pair.ends[k]);
    const auto [t, u] = pair.triangles;
    out_.segments[t].push_back({points[0], points[1], u});
    out_.segments[u].push_back({points[0], points[1], t});
  }

  std::uint32_t point_of(const CrossingPair::End& end) {
    if (end.edge[0] == end.edge[1]) return end.edge[0];
    const auto [known, is_new] = of_edge_.try_emplace({end.edge[0], end.edge[1], end.triangle}, next_point());
    if (is_new) {
      out_.points.push_back(geometry_.on_line(grid_[end.edge[0]], grid_[end.edge[1]], corners_of(end.triangle)));
      out_.on_edges[end.edge].push_back(known->second);
    }
    return known->second;
  }

  std::uint32_t next_point() const { return static_cast<std::uint32_t>(mesh_.vertices.size() + out_.points.size()); }

  GridTriangle corners_of(std::uint32_t t) const {
    const Triangle& c = mesh_.triangles[t];
    return {grid_[c[0]], grid_[c[1]], grid_[c[2]]};
  }

  /// A point where three triangles cross lies in each of them, on both of its segments with the others.
  bool find_triple_points() {
    for (const CrossingPair& pair : pairs_) {
      const auto [t, u] = pair.triangles;
      for (const CrossingSegment& second : out_.segments[t]) {
        const std::uint32_t v = second.other;
        if (v > u && crosses(u, v) && !add_triple_point(t, u, v)) return false;
      }
    }
    return true;
  }

  bool crosses(std::uint32_t t, std::uint32_t u) const {
    const std::vector<CrossingSegment>& list = out_.segments[t];  // by ascending `other`, as pairs are sorted
    const auto at = std::ranges::lower_bound(list, u, {}, &CrossingSegment::other);
    return at != list.end() && at->other == u;
  }

  const CrossingSegment& segment(std::uint32_t t, std::uint32_t u) const {
    return *std::ranges::lower_bound(out_.segments[t], u, {}, &CrossingSegment::other);
  }

  /// The point of these three, if there is one. False in a degenerate position.
  bool add_triple_point(std::uint32_t t, std::uint32_t u, std::uint32_t v) {
    const CrossingSegment &a = segment(t, u), &b = segment(t, v);
    if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return true;
    const int axis = projection_axis(corners_of(t));
    const ExactPoint p = exact(a.from), q = exact(a.to), r = exact(b.from), s = exact(b.to);
    const int r_side = geometry_.orientation(p, q, r, axis), s_side = geometry_.orientation(p, q, s, axis);
    const int p_side = geometry_.orientation(r, s, p, axis), q_side = geometry_.orientation(r, s, q, axis);
    if (r_side * s_side > 0 || p_side * q_side > 0) return true;
    if (r_side * s_side * p_side * q_side == 0) return false;
    ExactPoint point;
    if (!geometry_.on_planes({corners_of(t), corners_of(u), corners_of(v)}, point)) return false;
    for (const std::uint32_t triangle : {t, u, v}) out_.inside[triangle].push_back(next_point());
    out_.points.push_back(std::move(point));
    return true;
  }

  ExactPoint exact(std::uint32_t point) {
    const auto vertices = static_cast<std::uint32_t>(mesh_.vertices.size());
    return point < vertices ? geometry_.vertex(grid_[point]) : out_.points[point - vertices];
  }

  const Mesh& mesh_;
  const std::vector<Point>& grid_;
  const double moved_;
  const TriangleTree& tree_;
  const std::vector<bool>& crossed_;
  const unsigned threads_;
  ExactGeometry geometry_;
  std::vector<CrossingPair> pairs_;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> of_edge_;  // by edge and triangle
  Crossings out_;
};

}  // namespace

std::optional<Crossings> find_crossings(const Mesh& mesh, const GridPositions& grid, const TriangleTree& tree,
                                        const std::vector<bool>& crossed, unsigned threads) {
  return CrossingFinder(mesh, grid, tree, crossed, threads).run();
}

}  // namespace medial_vk
