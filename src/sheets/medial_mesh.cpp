#include "sheets/medial_mesh.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "sheets/concurrent_sets.h"
#include "sheets/holes.h"
#include "sheets/mesh_topology_counts.h"
#include "sheets/triangle_fans.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {
namespace {

/// A triangle by place, and how it is ranked: the smaller its circumscribed circle, the sooner.
struct Candidate {
  double squared_circumradius;
  MeshTriangle corners;
  bool operator<(const Candidate& other) const {
    return std::tie(squared_circumradius, corners) < std::tie(other.squared_circumradius, other.corners);
  }
};

struct TriangleHash {
  std::size_t operator()(const MeshTriangle& t) const {
    // Fibonacci hashing, corner by corner.
    std::uint64_t key = 0;
    for (const std::uint32_t corner : t) key = (key ^ corner) * 0x9e3779b97f4a7c15ull;
    return static_cast<std::size_t>(key ^ key >> 32);
  }
};

double squared_circumradius(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, bc = c - b;
  const Point area = cross(ab, ac);
  const double square = dot(area, area);
  if (!(square > 0)) return std::numeric_limits<double>::infinity();
  return dot(ab, ab) * dot(ac, ac) * dot(bc, bc) / (4 * square);
}

class Builder {
 public:
  Builder(const VoxelGraph& graph, const Sheets& sheets, double epsilon)
      : graph_(graph), fans_(graph), leaders_(graph.size()) {
    for (std::uint32_t place = 0; place < graph.size(); ++place) leaders_[place] = find_leader(place, 2 * epsilon);
    sheet_of_.reserve(graph.size());
    for (std::uint32_t place = 0; place < graph.size(); ++place) {
      sheet_of_.push_back(sheets.of_point[graph.index(place)]);
    }
  }

  void run() {
    join_crowds();
    join_within_sheets();
    for (const bool empty : {true, true, false, false}) add_with_room(ears(empty));
    join_across_seams();
    close_holes();
    join_curves();
    join_components();
  }

  const std::vector<MeshTriangle>& triangles() const { return triangles_; }
  std::vector<MeshEdge> edges() const {
    std::vector<MeshEdge> out;
    for (const auto& [key, count] : edges_) out.push_back(ends_of(key));
    return out;
  }

 private:
  /// Seen along the normal, points that crowd at the wall between two voxels may lie behind one another. The first of
  /// them that leads itself stands for them.
  std::uint32_t find_leader(std::uint32_t place, double reach) const {
    for (const std::uint32_t other : graph_.neighbours(place)) {
      if (other > place) break;
      if (leaders_[other] == other && squared_distance(place, other) <= reach * reach) return other;
    }
    return place;
  }

  bool leads(std::uint32_t place) const { return leaders_[place] == place; }

  /// An edge to a point that has no other changes no topology.
  void join_crowds() {
    for (std::uint32_t place = 0; place < graph_.size(); ++place) {
      if (!leads(place)) edges_.try_emplace(edge(place, leaders_[place]), 0);
    }
  }

  /// All triangles of three voxels that touch each other, with `sheets` sheets among their corners.
  std::vector<Candidate> candidates(std::size_t sheets) const {
    std::vector<Candidate> out;
    for (std::uint32_t a = 0; a < graph_.size(); ++a) {
      if (!leads(a)) continue;
      const auto around = graph_.neighbours(a);
      for (std::size_t i = 0; i < around.size(); ++i) {
        if (around[i] < a || !leads(around[i])) continue;
        for (std::size_t j = i + 1; j < around.size(); ++j) {
          if (!leads(around[j])) continue;
          if (count_sheets(a, around[i], around[j]) != sheets || !graph_.touch(around[i], around[j])) continue;
          const double circle = squared_circumradius(graph_.sphere(a).centre, graph_.sphere(around[i]).centre,
                                                     graph_.sphere(around[j]).centre);
          if (circle < std::numeric_limits<double>::infinity()) out.push_back({circle, {a, around[i], around[j]}});
        }
      }
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  std::size_t count_sheets(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const std::int32_t x = sheet_of_[a], y = sheet_of_[b], z = sheet_of_[c];
    return 1 + (y != x) + (z != x && z != y);
  }

  bool has_room(const MeshTriangle& t, int k) const { return fans_.has_room(t[k], t[(k + 1) % 3], t[(k + 2) % 3]); }

  /// Unless it closes a bubble.
  void add(const MeshTriangle& t) {
    if (!boundaries_.add({edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])})) return;
    triangles_.push_back(t);
    present_.insert(t);
    for (int k = 0; k < 3; ++k) {
      fans_.add(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
      ++edges_[edge(t[k], t[(k + 1) % 3])];
    }
  }

  /// Both ends of an edge in one number, the greater first: numbers ascend along the voxels, as Boundaries wants them.
  static std::uint64_t edge(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::max(a, b)} << 32 | std::min(a, b);
  }
  static MeshEdge ends_of(std::uint64_t key) {
    return {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  }

  int triangles_at(std::uint32_t a, std::uint32_t b) const {
    const auto found = edges_.find(edge(a, b));
    return found == edges_.end() ? 0 : found->second;
  }

  /// Is no other point of the sheet in the ball around the circumscribed circle? On a flat sheet that is the triangle's
  /// empty circle, the mark of a Delaunay triangulation. Points on the circle do not count.
  bool is_empty(const Candidate& candidate) const {
    const MeshTriangle& t = candidate.corners;
    const Point& origin = graph_.sphere(t[0]).centre;
    const Point u = graph_.sphere(t[1]).centre - origin, v = graph_.sphere(t[2]).centre - origin;
    const Point n = cross(u, v);
    const Point centre = origin + 1 / (2 * dot(n, n)) * (dot(u, u) * cross(v, n) + dot(v, v) * cross(n, u));
    const double least = (1 - 1e-9) * candidate.squared_circumradius;
    return std::ranges::none_of(t, [&](std::uint32_t corner) {
      return std::ranges::any_of(graph_.neighbours(corner), [&](std::uint32_t other) {
        if (sheet_of_[other] != sheet_of_[corner] || !leads(other)) return false;
        if (other == t[0] || other == t[1] || other == t[2]) return false;
        const Point d = graph_.sphere(other).centre - centre;
        return dot(d, d) < least;
      });
    });
  }

  /// Those of empty circles, then others, small circles first, as long as the triangles around each corner do not
  /// overlap. The others serve where a triangle of an empty circle would join voxels that do not touch.
  void join_within_sheets() {
    const std::vector<Candidate> all = candidates(1);
    std::vector<Candidate> empty;
    std::ranges::copy_if(all, std::back_inserter(empty), [&](const Candidate& c) { return is_empty(c); });
    add_with_room(empty);
    add_with_room(all);
  }

  void add_with_room(const std::vector<Candidate>& candidates) {
    for (const Candidate& candidate : candidates) {
      const MeshTriangle& t = candidate.corners;
      if (!present_.contains(t) && has_room(t, 0) && has_room(t, 1) && has_room(t, 2)) add(t);
    }
  }

  /// Triangles at two sides that have one triangle, whose other ends are two voxels apart: where points lie so in their
  /// voxels that no triangle of voxels that touch closes a hole of a sheet. Not beside seams, which have strips.
  std::vector<Candidate> ears(bool empty) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> open;
    for (const auto& [key, count] : edges_) {
      if (count != 1) continue;
      open[ends_of(key)[0]].push_back(ends_of(key)[1]);
      open[ends_of(key)[1]].push_back(ends_of(key)[0]);
    }
    std::vector<Candidate> out;
    for (auto& [tip, ends] : open) {
      std::sort(ends.begin(), ends.end());
      for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t j = i + 1; j < ends.size(); ++j) {
          if (!two_apart(ends[i], ends[j]) || is_at_seam(tip) || is_at_seam(ends[i]) || is_at_seam(ends[j])) continue;
          Candidate ear = {squared_circumradius(graph_.sphere(tip).centre, graph_.sphere(ends[i]).centre,
                                                graph_.sphere(ends[j]).centre),
                           {tip, ends[i], ends[j]}};
          std::sort(ear.corners.begin(), ear.corners.end());
          if (!(ear.squared_circumradius < std::numeric_limits<double>::infinity())) continue;
          if (!empty || is_empty(ear)) out.push_back(ear);
        }
      }
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  bool is_at_seam(std::uint32_t place) const {
    return std::ranges::any_of(graph_.neighbours(place),
                               [&](std::uint32_t other) { return sheet_of_[other] != sheet_of_[place]; });
  }

  bool two_apart(std::uint32_t a, std::uint32_t b) const {
    const auto &u = graph_.sphere(a).voxel, &v = graph_.sphere(b).voxel;
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::max(u[i], v[i]) - std::min(u[i], v[i]));
    return most == 2;
  }

  /// Where sheets meet, each is joined to the one of them with the lowest number only: a seam of three sheets is an
  /// edge of three triangles, and no tube of three strips around it.
  bool another_joins_them(const MeshTriangle& t) const {
    const std::int32_t host = std::min({sheet_of_[t[0]], sheet_of_[t[1]], sheet_of_[t[2]]});
    return std::ranges::any_of(t, [&](std::uint32_t corner) {
      return std::ranges::any_of(graph_.neighbours(corner),
                                 [&](std::uint32_t other) { return sheet_of_[other] < host; });
    });
  }

  /// A strip of triangles between the border of a sheet and its host. The edge within one of the sheets must be there,
  /// and each strip has one triangle at it; edges across have two at most. The sheet that ends here has its normal's
  /// view of the strip, in which triangles do not overlap; the host need not, as it may go on.
  void join_across_seams() {
    std::map<std::pair<std::uint64_t, std::int32_t>, bool> taken;
    for (const Candidate& candidate : candidates(2)) {
      const MeshTriangle& t = candidate.corners;
      int apex = 0;
      while (sheet_of_[t[(apex + 1) % 3]] != sheet_of_[t[(apex + 2) % 3]]) ++apex;
      const std::uint32_t tip = t[apex], left = t[(apex + 1) % 3], right = t[(apex + 2) % 3];
      if (triangles_at(left, right) == 0 || triangles_at(tip, left) > 1 || triangles_at(tip, right) > 1) continue;
      bool& base_taken = taken[{edge(left, right), sheet_of_[tip]}];
      if (base_taken || another_joins_them(t)) continue;
      const std::int32_t guest = std::max(sheet_of_[tip], sheet_of_[left]);
      bool room = true;
      for (int k = 0; k < 3; ++k) room = room && (sheet_of_[t[k]] != guest || has_room(t, k));
      if (!room) continue;
      base_taken = true;
      add(t);
    }
  }

  /// What is left open between strips. Where two sides of a hole meet and their other ends touch, a triangle makes the
  /// hole smaller by a side (within a sheet it would grow over the rim); where three or four sides are there, triangles
  /// close it, unless they would close a bubble.
  void close_holes() {
    for (int round = 0; round < 2; ++round) {
      for (const std::size_t sheets : {2u, 3u})
        add_if(candidates(sheets), [&](int open, int missing) { return missing == 1 && open == 2; });
    }
    for (const std::size_t sheets : {1u, 2u, 3u}) {
      const std::vector<Candidate> all = candidates(sheets);
      add_if(all, [](int, int missing) { return missing == 0; });
      for (const Candidate& candidate : all) close_with_partner(candidate.corners);
    }
  }

  /// Two triangles that share the only side of the first that is no edge yet, if they close a hole of four sides.
  void close_with_partner(const MeshTriangle& t) {
    int missing = 0, open = 0, tip = 0;
    for (int k = 0; k < 3; ++k) {
      const auto side = edges_.find(edge(t[(k + 1) % 3], t[(k + 2) % 3]));
      if (side != edges_.end() && side->second <= 1) ++open;
      if (side != edges_.end()) continue;
      ++missing;
      tip = k;
    }
    // Within a sheet all sides of a hole are open.
    if (missing != 1 || (open < 2 && count_sheets(t[0], t[1], t[2]) == 1)) return;
    const std::uint32_t at = t[tip], left = t[(tip + 1) % 3], right = t[(tip + 2) % 3];
    for (const std::uint32_t other : graph_.neighbours(left)) {
      if (other == at || !edges_.contains(edge(other, left)) || !edges_.contains(edge(other, right))) continue;
      const std::array loop = {edge(at, left), edge(left, other), edge(other, right), edge(right, at)};
      if (boundaries_.is_boundary(loop)) continue;
      add(t);
      MeshTriangle partner = {left, right, other};
      std::sort(partner.begin(), partner.end());
      add(partner);
      return;
    }
  }

  /// Adds candidates by how many of their sides have one triangle, and how many are no edges yet.
  template <class Wanted>
  void add_if(const std::vector<Candidate>& candidates, Wanted wanted) {
    for (const Candidate& candidate : candidates) {
      const MeshTriangle& t = candidate.corners;
      int open = 0, missing = 0;
      for (int k = 0; k < 3; ++k) {
        const auto found = edges_.find(edge(t[k], t[(k + 1) % 3]));
        if (found == edges_.end()) ++missing;
        if (found != edges_.end() && found->second == 1) ++open;
      }
      if (wanted(open, missing) && !present_.contains(t)) add(t);
    }
  }

  double squared_distance(std::uint32_t a, std::uint32_t b) const {
    const Point d = graph_.sphere(a).centre - graph_.sphere(b).centre;
    return dot(d, d);
  }

  /// A point without triangles is on a curve: it is joined to its relative neighbours (Toussaint 1980), those with no
  /// third point nearer to both, which follow curves without short cuts.
  void join_curves() {
    std::vector<bool> on_surface(graph_.size(), false);
    for (const MeshTriangle& t : triangles_) {
      for (const std::uint32_t corner : t) on_surface[corner] = true;
    }
    for (std::uint32_t a = 0; a < graph_.size(); ++a) {
      if (on_surface[a] || !leads(a)) continue;
      for (const std::uint32_t b : graph_.neighbours(a)) {
        if (!leads(b)) continue;
        const double length = squared_distance(a, b);
        const bool shortcut = std::ranges::any_of(graph_.neighbours(a), [&](std::uint32_t c) {
          return c != b && leads(c) && squared_distance(a, c) < length && squared_distance(b, c) < length;
        });
        if (!shortcut) edges_.try_emplace(edge(a, b), 0);
      }
    }
  }

  /// What touches stays together: the shortest edges between components (Kruskal 1956).
  void join_components() {
    ConcurrentSets sets(graph_.size());
    for (const auto& [key, count] : edges_) sets.join(ends_of(key)[0], ends_of(key)[1]);
    std::vector<std::pair<double, MeshEdge>> gaps;
    for (std::uint32_t a = 0; a < graph_.size(); ++a) {
      for (const std::uint32_t b : graph_.neighbours(a)) {
        if (b > a && sets.root(a) != sets.root(b)) gaps.push_back({squared_distance(a, b), {a, b}});
      }
    }
    std::sort(gaps.begin(), gaps.end());
    for (const auto& [length, ends] : gaps) {
      if (sets.root(ends[0]) == sets.root(ends[1])) continue;
      sets.join(ends[0], ends[1]);
      edges_.try_emplace(edge(ends[0], ends[1]), 0);
    }
  }

  const VoxelGraph& graph_;
  TriangleFans fans_;
  std::vector<std::uint32_t> leaders_;  // by place: itself, or the point that stands for it
  std::vector<std::int32_t> sheet_of_;
  std::vector<MeshTriangle> triangles_;
  Boundaries boundaries_;
  std::unordered_set<MeshTriangle, TriangleHash> present_;  // the same
  std::unordered_map<std::uint64_t, int> edges_;            // with the number of their triangles
};

}  // namespace

MedialMesh make_medial_mesh(std::span<const MedialSphere> spheres, const Sheets& sheets, double epsilon) {
  const VoxelGraph graph(spheres);
  Builder builder(graph, sheets, epsilon);
  builder.run();
  MedialMesh mesh;
  for (const MeshTriangle& t : builder.triangles()) {
    mesh.triangles.push_back({graph.index(t[0]), graph.index(t[1]), graph.index(t[2])});
  }
  for (const MeshEdge& ends : builder.edges()) {
    mesh.edges.push_back({graph.index(ends[0]), graph.index(ends[1])});
  }
  complete_medial_mesh(spheres.size(), sheets, mesh);
  return mesh;
}

MedialMesh restrict_medial_mesh(const MedialMesh& mesh, std::span<const MedialSphere> spheres, const Sheets& sheets,
                                const std::function<bool(std::span<const std::uint32_t>)>& in_complex) {
  MedialMesh out;
  std::ranges::copy_if(mesh.edges, std::back_inserter(out.edges), in_complex);
  std::ranges::copy_if(mesh.triangles, std::back_inserter(out.triangles), [&](const MeshTriangle& t) {
    const MeshEdge sides[] = {{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}};
    return in_complex(t) && std::ranges::all_of(sides, [&](const MeshEdge& side) { return in_complex(side); });
  });
  complete_medial_mesh(spheres.size(), sheets, out);
  return out;
}

}  // namespace medial_vk
