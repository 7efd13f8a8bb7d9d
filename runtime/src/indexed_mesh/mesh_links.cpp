#include "indexed_mesh/mesh_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

using gpu::uint;

constexpr double kRightAngle = std::numbers::pi / 2;
// Trusted normals are accurate to 1e-7 (prepare_mesh.cpp), and edges come from coordinates that were rounded when
// written: features within this angle (radians) of being touchable count as touchable.
constexpr double kTouchSlack = 3e-7;
// Normals closer than this count as one: faces are listed with a cap of twice that
// (shaders/shared/certified/carriers.glsl), and hold their edges and vertices.
constexpr double kFlat = 5e-6;
// Two sides of an untrusted triangle at a larger angle than this (its sine) give a normal accurate to 1e-9.
constexpr double kLeastCornerSine = 1e-6;
// Axes and angles are stored as floats.
constexpr double kCapSlack = 1e-6;
// Spokes to a face, an edge between faces that count as one, or a corner of such: within this of its normal.
constexpr double kFaceSpread = 1e-5;
// Consecutive vertices that a thread processes.
constexpr std::size_t kVerticesOfBlock = 2048;

Point unit(const Point& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Point{0, 0, 0};
}

// Of unit vectors; exact for small angles too.
double angle_between(const Point& a, const Point& b) { return 2 * std::asin(std::min(1.0, 0.5 * length(b - a))); }

struct Cap {
  Point axis;
  double angle;
};

// Of unit vectors.
const Point& farthest_from(const Point& axis, std::span<const Point> directions) {
  std::size_t farthest = 0;
  double least = 2;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double cosine = dot(directions[i], axis);
    farthest = cosine < least ? i : farthest;
    least = std::min(least, cosine);
  }
  return directions[farthest];
}

// A cap below a right angle that holds all directions, nearly the smallest: the axis moves towards the direction
// farthest from it, by decreasing steps (Badoiu and Clarkson 2003). No value without directions.
std::optional<Cap> cap_around(std::span<const Point> directions) {
  constexpr int kSteps = 16;
  if (directions.empty()) return std::nullopt;
  Point sum = {0, 0, 0};
  for (const Point& d : directions) sum = sum + d;
  Point axis = unit(sum);
  for (int step = 0; step < kSteps; ++step) {
    axis = unit(axis + (1 / (step + 2.5)) * (farthest_from(axis, directions) - axis));
  }
  double angle = 0;
  for (const Point& d : directions) angle = std::max(angle, angle_between(d, axis));
  if (length(axis) == 0 || angle + kCapSlack >= kRightAngle) return std::nullopt;
  return Cap{axis, angle + kCapSlack};
}

struct Sides {
  bool front = true, back = true;
};

// For each of s and -s: true if it is at most a right angle from all edges, with slack.
Sides supported_sides(const Point& s, std::span<const Point> edges) {
  Sides sides;
  for (const Point& edge : edges) {
    const double along = dot(s, edge);
    sides.front = sides.front && along >= -kTouchSlack;
    sides.back = sides.back && along <= kTouchSlack;
    if (!sides.front && !sides.back) break;
  }
  return sides;
}

// The extreme rays of {s : s.e >= 0 for all edges e}, with slack; no value if two edges are too close to a line.
std::optional<std::vector<Point>> supporting_rays(std::span<const Point> edges) {
  std::vector<Point> rays;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point across = cross(edges[i], edges[j]);
      const double size = length(across);
      if (size < 1e-6) return std::nullopt;
      const Point ray = (1 / size) * across;
      const Sides sides = supported_sides(ray, edges);
      if (sides.front) rays.push_back(ray);
      if (sides.back) rays.push_back(-1.0 * ray);
    }
  }
  return rays;
}

gpu::vec4 to_gpu(const Cap& cap) {
  return {static_cast<float>(cap.axis[0]), static_cast<float>(cap.axis[1]), static_cast<float>(cap.axis[2]),
          static_cast<float>(cap.angle)};
}

constexpr gpu::vec4 kAnySpoke = {0, 0, 1, 4}, kNoSpoke = {0, 0, 1, -1};

// Lemma D at a vertex. The spokes form a convex cone inside both the cap of the normals and the cone of the rays. If
// the axis of the cap, less than a right angle away from every possible spoke, is at least a right angle from every
// ray, there is no spoke.
gpu::vec4 corner_cap(std::span<const Point> normals, std::span<const Point> edges) {
  const std::optional<Cap> by_normals = cap_around(normals);
  if (!by_normals) return kAnySpoke;
  if (by_normals->angle < kFlat / 2 + kCapSlack) return kNoSpoke;
  const std::optional<std::vector<Point>> rays = supporting_rays(edges);
  if (!rays) return to_gpu(*by_normals);
  const auto points_away = [&](const Point& ray) { return dot(ray, by_normals->axis) <= 0; };
  if (std::all_of(rays->begin(), rays->end(), points_away)) return kNoSpoke;
  const std::optional<Cap> by_edges = cap_around(*rays);
  return to_gpu(by_edges && by_edges->angle < by_normals->angle ? *by_edges : *by_normals);
}

// Lemma I at a vertex: spokes from any side. The cone of directions s with s.e >= 0 for all edges e, as a cap.
gpu::vec4 corner_cap_from_all_sides(std::span<const Point> edges) {
  constexpr std::size_t kMostEdges = 48;  // the rays take the cube of their number
  if (edges.size() > kMostEdges) return kAnySpoke;
  const std::optional<std::vector<Point>> rays = supporting_rays(edges);
  if (!rays) return kAnySpoke;
  if (rays->empty()) return kNoSpoke;
  const std::optional<Cap> cap = cap_around(*rays);
  return cap ? to_gpu(*cap) : kAnySpoke;
}

// Lemma I on an edge: all directions s across it with s.d >= 0 for the directions d in which its triangles leave it.
// The d lie in an arc, the circle without the widest gap between two of them; the s are in an arc with the same middle,
// and both are a straight angle together. No value if there are none, or only the normals of two triangles in a plane.
std::optional<Cap> arc_of_spokes(const Point& along, std::span<const Point> across) {
  const Point u = across[0], v = cross(along, u);
  std::vector<double> angles;
  for (const Point& d : across) angles.push_back(std::atan2(dot(d, v), dot(d, u)));
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * std::numbers::pi - angles.back(), first = angles.front();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] <= gap) continue;
    gap = angles[i] - angles[i - 1];
    first = angles[i];
  }
  const double spread = 2 * std::numbers::pi - gap, half = kRightAngle - spread / 2;
  if (half < kFlat / 2) return std::nullopt;
  const double middle = first + spread / 2;
  return Cap{unit(std::cos(middle) * u + std::sin(middle) * v), half + kCapSlack};
}

// A directed edge of a triangle, as a key that both its triangles share.
struct HalfEdge {
  uint low, high, position;
  std::uint8_t corner;
  bool rising;
};

class Builder {
 public:
  Builder(const MeshView& mesh, std::span<const std::uint32_t> order, unsigned threads)
      : mesh_(mesh), order_(order), threads_(threads) {}

  MeshLinks build() {
    measure_triangles();
    link_edges();
    link_corners();
    measure_spreads();
    return std::move(out_);
  }

 private:
  const Triangle& triangle(uint position) const { return mesh_.triangles[order_[position]]; }
  const Point& corner(uint position, int k) const { return mesh_.vertices[triangle(position)[k % 3]]; }

  void measure_triangles() {
    normals_.resize(order_.size());
    turns_.resize(order_.size());
    out_.links.resize(order_.size());
    for (uint p = 0; p < order_.size(); ++p) {
      normals_[p] = unit(cross(corner(p, 1) - corner(p, 0), corner(p, 2) - corner(p, 0)));
      const bool trusted = !mesh_.flags.empty() && (mesh_.flags[order_[p]] & kTrustedNormal) != 0;
      const Triangle& t = triangle(p);
      out_.links[p] = {{t[0], t[1], t[2]}, 0, {gpu::kNoLink, gpu::kNoLink, gpu::kNoLink}, 0};
      if (!trusted || length(normals_[p]) == 0) distrust(p);
      const bool uncrossed = !mesh_.flags.empty() && (mesh_.flags[order_[p]] & (kTrustedNormal | kUncrossed)) != 0;
      if (uncrossed) out_.links[p].flags |= gpu::kLinkUncrossed;
    }
  }

  void distrust(uint p) {
    const Point first = corner(p, 1) - corner(p, 0), second = corner(p, 2) - corner(p, 0);
    const bool thin = length(cross(first, second)) < kLeastCornerSine * length(first) * length(second);
    out_.links[p].flags |= thin ? gpu::kLinkWhole : gpu::kLinkBothSides;
  }

  // By low, high, position: a counting sort by the first, which leaves runs of a few edges to sort by the others.
  std::vector<HalfEdge> sorted_edges() const {
    std::vector<std::size_t> begin(mesh_.vertices.size() + 1, 0);
    const auto for_each = [&](auto visit) {
      for (uint p = 0; p < order_.size(); ++p) {
        for (std::uint8_t k = 0; k < 3; ++k) {
          const uint a = triangle(p)[k], b = triangle(p)[(k + 1) % 3];
          visit(HalfEdge{std::min(a, b), std::max(a, b), p, k, a < b});
        }
      }
    };
    for_each([&](const HalfEdge& edge) { ++begin[edge.low + 1]; });
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<HalfEdge> edges(3 * order_.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for_each([&](const HalfEdge& edge) { edges[next[edge.low]++] = edge; });
    const auto at = [&](std::size_t v) { return edges.begin() + static_cast<std::ptrdiff_t>(begin[v]); };
    parallel_blocks(mesh_.vertices.size(), kVerticesOfBlock, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        std::sort(at(v), at(v + 1), [](const HalfEdge& a, const HalfEdge& b) {
          return std::tie(a.high, a.position) < std::tie(b.high, b.position);
        });
      }
    });
    return edges;
  }

  bool is_untrusted(uint p) const { return (out_.links[p].flags & (gpu::kLinkWhole | gpu::kLinkBothSides)) != 0u; }
  bool is_whole(uint p) const { return (out_.links[p].flags & gpu::kLinkWhole) != 0u; }

  // Visits every edge as the span of its directed edges, the earlier triangles first.
  template <class Visit>
  static void for_each_edge(const std::vector<HalfEdge>& edges, const Visit& visit) {
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
      visit(std::span(edges).subspan(i, end - i));
    }
  }

  static bool is_regular(std::span<const HalfEdge> edge) {
    return edge.size() == 2 && edge[0].rising != edge[1].rising;
  }

  // Of an edge between p and q, the earlier triangle lists it: both are contacts wherever a spoke ends on it.
  void link_edges() {
    const std::vector<HalfEdge> edges = sorted_edges();
    for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
      if (is_regular(edge)) return;
      for (const HalfEdge& e : edge) {
        if (!is_untrusted(e.position)) distrust(e.position);
      }
    });
    for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
      const auto untrusted = [&](const HalfEdge& e) { return is_untrusted(e.position); };
      const auto whole = [&](const HalfEdge& e) { return is_whole(e.position); };
      const auto owner = std::find_if(edge.begin(), edge.end(), untrusted);
      if (owner == edge.end()) {
        link(edge[0], edge[1]);
      } else if (std::none_of(edge.begin(), edge.end(), whole)) {
        link_arc(edge, *owner);
      }
    });
  }

  void link_arc(std::span<const HalfEdge> edge, const HalfEdge& owner) {
    const Point& from = mesh_.vertices[owner.low];
    const Point along = unit(mesh_.vertices[owner.high] - from);
    std::vector<Point> across;
    for (const HalfEdge& e : edge) {
      const Point d = corner(e.position, e.corner + 2) - from;
      across.push_back(unit(d - dot(d, along) * along));
    }
    const std::optional<Cap> arc = arc_of_spokes(along, across);
    if (!arc) return;
    gpu::TriangleLinks& links = out_.links[owner.position];
    links.flags |= gpu::kLinkEdge << owner.corner;
    links.neighbour[owner.corner] = static_cast<uint>(mesh_.vertices.size() + arcs_.size());
    arcs_.push_back(to_gpu(*arc));
  }

  void link(const HalfEdge& first, const HalfEdge& second) {
    const std::array<uint, 3> vertices = triangle(second.position);
    const uint apex = vertices[(second.corner + 2) % 3];
    const Point d = mesh_.vertices[apex] - corner(first.position, first.corner);
    // The apex is outside the plane of the first: the edge is reflex.
    const bool reflex = dot(normals_[first.position], d) >= -kTouchSlack * length(d);
    const bool flat = length(normals_[first.position] - normals_[second.position]) < kFlat;
    gpu::TriangleLinks& links = out_.links[first.position];
    links.neighbour[first.corner] = second.position;
    if (!reflex || flat) return;
    links.flags |= gpu::kLinkEdge << first.corner;
    const double turn = angle_between(normals_[first.position], normals_[second.position]);
    for (const uint p : {first.position, second.position}) turns_[p] = std::max(turns_[p], turn);
  }

  // A feature that a triangle without a good normal shares need not be listed: that triangle is listed as a whole.
  void link_corners() {
    std::vector<uint> begin(mesh_.vertices.size() + 1, 0), fans(3 * order_.size());
    for (uint p = 0; p < order_.size(); ++p)
      for (const uint v : triangle(p)) ++begin[v + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<uint> next(begin.begin(), begin.end() - 1);
    for (uint p = 0; p < order_.size(); ++p)
      for (const uint v : triangle(p)) fans[next[v]++] = p;
    out_.corners.resize(mesh_.vertices.size(), kNoSpoke);
    loose_.resize(mesh_.vertices.size());
    const auto fan_of = [&](std::size_t v) {
      return std::span<const uint>(fans).subspan(begin[v], begin[v + 1] - begin[v]);
    };
    parallel_blocks(mesh_.vertices.size(), kVerticesOfBlock, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) measure_corner(static_cast<uint>(v), fan_of(v));
    });
    for (uint v = 0; v < mesh_.vertices.size(); ++v) {
      if (out_.corners[v].w >= 0) link_corner(v, fan_of(v));
    }
    out_.corners.insert(out_.corners.end(), arcs_.begin(), arcs_.end());
  }

  void measure_corner(uint vertex, std::span<const uint> fan) {
    loose_[vertex] = std::any_of(fan.begin(), fan.end(), [&](uint p) { return is_untrusted(p); }) ? 1 : 0;
    if (fan.empty() || std::any_of(fan.begin(), fan.end(), [&](uint p) { return is_whole(p); })) return;
    if (loose_[vertex] != 0) {
      out_.corners[vertex] = corner_cap_from_all_sides(edges_from(vertex, fan));
      return;
    }
    std::vector<Point> normals, edges;
    for (const uint p : fan) {
      const Triangle& t = triangle(p);
      const int k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      normals.push_back(normals_[p]);
      edges.push_back(unit(corner(p, k + 1) - corner(p, k)));
    }
    out_.corners[vertex] = corner_cap(normals, edges);
  }

  // Unit, each once.
  std::vector<Point> edges_from(uint vertex, std::span<const uint> fan) const {
    std::vector<uint> ends;
    for (const uint p : fan) {
      for (const uint end : triangle(p)) {
        if (end != vertex) ends.push_back(end);
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<Point> edges;
    edges.reserve(ends.size());
    for (const uint end : ends) edges.push_back(unit(mesh_.vertices[end] - mesh_.vertices[vertex]));
    return edges;
  }

  // Lemma L. The lemma is not applied to a triangle beside an untrusted one: only its own trust is known then.
  void measure_spreads() {
    out_.spreads.resize(order_.size());
    parallel_blocks(order_.size(), kVerticesOfBlock, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p) {
        double angle = turns_[p];
        for (const uint v : triangle(static_cast<uint>(p))) angle = std::max(angle, turn_at_corner(v, normals_[p]));
        out_.spreads[p] = angle + kFaceSpread < kRightAngle ? static_cast<float>(std::sin(angle + kFaceSpread)) : 1.0f;
      }
    });
  }

  double turn_at_corner(uint vertex, const Point& normal) const {
    if (loose_[vertex] != 0) return kRightAngle;
    const gpu::vec4& cap = out_.corners[vertex];
    return cap.w < 0 ? 0 : angle_between(normal, Point{cap.x, cap.y, cap.z}) + cap.w;
  }

  void link_corner(uint vertex, std::span<const uint> fan) {
    const Triangle& owner = triangle(fan.front());  // the earliest
    const uint k = owner[0] == vertex ? 0 : owner[1] == vertex ? 1 : 2;
    out_.links[fan.front()].flags |= gpu::kLinkCorner << k;
  }

  const MeshView& mesh_;
  std::span<const std::uint32_t> order_;
  unsigned threads_;
  std::vector<Point> normals_;
  std::vector<double> turns_;        // by position: greatest angle to the normal of a triangle beyond a reflex edge
  std::vector<std::uint8_t> loose_;  // by vertex: 1 if some triangle at it is not trusted
  std::vector<gpu::vec4> arcs_;      // of spokes to edges of untrusted triangles
  MeshLinks out_;
};

}  // namespace

MeshLinks make_mesh_links(const MeshView& mesh, std::span<const std::uint32_t> order, unsigned threads) {
  return Builder(mesh, order, thread_count(threads)).build();
}

}  // namespace medial_vk
