#include "mesh_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "parallel_blocks.h"
#include "point_math.h"

namespace medial_vk {
namespace {

using gpu::uint;

constexpr double kRightAngle = std::numbers::pi / 2;
// Trusted normals are right to 1e-7 (prepare_mesh.cpp), and edges come from coordinates that were rounded when they
// were written: features within this (radians) of being touchable count as touchable.
constexpr double kTouchSlack = 3e-7;
// Normals closer than this count as one: faces are listed with a cap of twice that (shaders/shared/carriers.glsl), and
// hold their edges and vertices.
constexpr double kFlat = 5e-6;
// Axes and angles are stored as floats.
constexpr double kCapSlack = 1e-6;
// Vertices that a thread looks at in one go.
constexpr std::size_t kBlock = 2048;

Point unit(const Point& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Point{0, 0, 0};
}

struct Cap {
  Point axis;
  double angle;
};

// A cap below a right angle that holds all directions, nearly the smallest: the axis moves towards the direction
// farthest from it, a little less each time (Badoiu and Clarkson 2003).
std::optional<Cap> cap_around(std::span<const Point> directions) {
  constexpr int kSteps = 16;
  Point sum = {0, 0, 0};
  for (const Point& d : directions) sum = sum + d;
  Point axis = unit(sum);
  for (int step = 0; step < kSteps; ++step) {
    const auto farthest = std::min_element(directions.begin(), directions.end(),
                                           [&](const Point& a, const Point& b) { return dot(a, axis) < dot(b, axis); });
    axis = unit(axis + (1 / (step + 2.5)) * (*farthest - axis));
  }
  double angle = 0;
  for (const Point& d : directions) angle = std::max(angle, 2 * std::asin(std::min(1.0, 0.5 * length(d - axis))));
  if (length(axis) == 0 || angle + kCapSlack >= kRightAngle) return std::nullopt;
  return Cap{axis, angle + kCapSlack};
}

// The extreme rays of {s : s.e >= 0 for all edges e}, with slack; nothing if two edges are too close to a line.
std::optional<std::vector<Point>> supporting_rays(std::span<const Point> edges) {
  std::vector<Point> rays;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point across = cross(edges[i], edges[j]);
      if (length(across) < 1e-6) return std::nullopt;
      for (const double sign : {1.0, -1.0}) {
        const Point ray = sign * unit(across);
        const auto supports = [&](const Point& edge) { return dot(ray, edge) >= -kTouchSlack; };
        if (std::all_of(edges.begin(), edges.end(), supports)) rays.push_back(ray);
      }
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
// the axis of the cap, less than a right angle away from every possible spoke, is at least that far from every ray,
// there is none.
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

// A directed edge of a triangle, as a key that both its triangles share.
struct HalfEdge {
  uint low, high, position;
  std::uint8_t corner;
  bool rising;
};

class Builder {
 public:
  Builder(const MeshView& mesh, std::span<const std::uint32_t> order) : mesh_(mesh), order_(order) {}

  MeshLinks build() {
    measure_triangles();
    link_edges();
    link_corners();
    return std::move(out_);
  }

 private:
  const Triangle& triangle(uint position) const { return mesh_.triangles[order_[position]]; }
  const Point& corner(uint position, int k) const { return mesh_.vertices[triangle(position)[k % 3]]; }

  void measure_triangles() {
    normals_.resize(order_.size());
    out_.links.resize(order_.size());
    for (uint p = 0; p < order_.size(); ++p) {
      normals_[p] = unit(cross(corner(p, 1) - corner(p, 0), corner(p, 2) - corner(p, 0)));
      const bool trusted = !mesh_.flags.empty() && (mesh_.flags[order_[p]] & kTrustedNormal) != 0;
      const Triangle& t = triangle(p);
      out_.links[p] = {
          {t[0], t[1], t[2]}, trusted ? 0u : gpu::kLinkWhole, {gpu::kNoLink, gpu::kNoLink, gpu::kNoLink}, 0};
    }
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
    parallel_blocks(mesh_.vertices.size(), kBlock, thread_count(0), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        std::sort(at(v), at(v + 1), [](const HalfEdge& a, const HalfEdge& b) {
          return std::tie(a.high, a.position) < std::tie(b.high, b.position);
        });
      }
    });
    return edges;
  }

  // Of an edge between p and q, the earlier triangle lists it: both are contacts wherever a spoke ends on it.
  void link_edges() {
    const std::vector<HalfEdge> edges = sorted_edges();
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
      if (end == i + 2 && edges[i].rising != edges[i + 1].rising) {
        link(edges[i], edges[i + 1]);
      } else {
        for (std::size_t j = i; j < end; ++j) out_.links[edges[j].position].flags |= gpu::kLinkWhole;
      }
    }
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
    if (reflex && !flat) links.flags |= gpu::kLinkEdge << first.corner;
    partners_.emplace_back(first.position, second.position);
  }

  // A feature that an untrusted triangle shares need not be listed: that triangle is listed as a whole.
  void link_corners() {
    for (const auto& [p, q] : partners_) {
      if ((out_.links[q].flags & gpu::kLinkWhole) == 0u) continue;
      const uint* neighbour = out_.links[p].neighbour;
      const auto edge = static_cast<uint>(std::find(neighbour, neighbour + 3, q) - neighbour);
      out_.links[p].flags &= ~(gpu::kLinkEdge << edge);
    }
    std::vector<uint> begin(mesh_.vertices.size() + 1, 0), fans(3 * order_.size());
    for (uint p = 0; p < order_.size(); ++p)
      for (const uint v : triangle(p)) ++begin[v + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<uint> next(begin.begin(), begin.end() - 1);
    for (uint p = 0; p < order_.size(); ++p)
      for (const uint v : triangle(p)) fans[next[v]++] = p;
    out_.corners.resize(mesh_.vertices.size(), kNoSpoke);
    const auto fan_of = [&](std::size_t v) {
      return std::span<const uint>(fans).subspan(begin[v], begin[v + 1] - begin[v]);
    };
    parallel_blocks(mesh_.vertices.size(), kBlock, thread_count(0), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) measure_corner(static_cast<uint>(v), fan_of(v));
    });
    for (uint v = 0; v < mesh_.vertices.size(); ++v) {
      if (out_.corners[v].w >= 0) link_corner(v, fan_of(v));
    }
  }

  void measure_corner(uint vertex, std::span<const uint> fan) {
    const auto whole = [&](uint p) { return (out_.links[p].flags & gpu::kLinkWhole) != 0u; };
    if (fan.empty() || std::any_of(fan.begin(), fan.end(), whole)) return;
    std::vector<Point> normals, edges;
    for (const uint p : fan) {
      const Triangle& t = triangle(p);
      const int k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      normals.push_back(normals_[p]);
      edges.push_back(unit(corner(p, k + 1) - corner(p, k)));
    }
    out_.corners[vertex] = corner_cap(normals, edges);
  }

  void link_corner(uint vertex, std::span<const uint> fan) {
    const Triangle& owner = triangle(fan.front());  // the earliest
    const uint k = owner[0] == vertex ? 0 : owner[1] == vertex ? 1 : 2;
    out_.links[fan.front()].flags |= gpu::kLinkCorner << k;
  }

  const MeshView& mesh_;
  std::span<const std::uint32_t> order_;
  std::vector<Point> normals_;
  std::vector<std::pair<uint, uint>> partners_;  // both triangles of every manifold edge, the earlier first
  MeshLinks out_;
};

}  // namespace

MeshLinks make_mesh_links(const MeshView& mesh, std::span<const std::uint32_t> order) {
  return Builder(mesh, order).build();
}

}  // namespace medial_vk
