#include "foam/clip_polytope.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {

ClipPolytope::ClipPolytope(double half_side) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](int axis) { return (corner >> axis & 1) != 0 ? half_side : -half_side; };
    vertices_.push_back({{side(0), side(1), side(2)}, {kBox, kBox, kBox}});
  }
  faces_ = {{{0, 4, 6, 2}, kBox}, {{1, 3, 7, 5}, kBox}, {{0, 1, 5, 4}, kBox},
            {{2, 6, 7, 3}, kBox}, {{0, 2, 3, 1}, kBox}, {{4, 5, 7, 6}, kBox}};
}

double ClipPolytope::reach_from(const Point& p) const {
  double reach = 0;
  for (const Vertex& v : vertices_) reach = std::max(reach, length(v.position - p));
  return reach;
}

/// One cut of a polytope: the removed vertices, and the new ones on the edges in between.
class ClipPolytope::Cut {
 public:
  Cut(std::vector<Vertex>& vertices, const HalfSpace& half_space, std::int32_t name, double margin)
      : vertices_(vertices), name_(name) {
    heights_.reserve(vertices.size());
    for (const Vertex& v : vertices)
      heights_.push_back(dot(half_space.normal, v.position) - half_space.offset - margin);
  }

  bool goes(std::uint32_t vertex) const { return heights_[vertex] > 0; }
  bool cuts_nothing() const {
    return std::none_of(heights_.begin(), heights_.end(), [](double h) { return h > 0; });
  }
  bool cuts_all() const {
    return std::all_of(heights_.begin(), heights_.end(), [](double h) { return h > 0; });
  }

  /// The face without its part outside. Where its outline leaves and returns, a straight segment joins the two new
  /// vertices; the same segment, reversed, belongs to the outline of the cap.
  Face clipped(const Face& face) {
    Face out = {{}, face.name};
    const std::size_t count = face.corners.size();
    std::size_t first = 0;
    while (first < count && goes(face.corners[first])) ++first;
    if (first == count) return out;
    std::uint32_t left_at = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t a = face.corners[(first + k) % count], b = face.corners[(first + k + 1) % count];
      if (!goes(a)) out.corners.push_back(a);
      if (goes(a) == goes(b)) continue;
      const std::uint32_t crossing = crossing_of(a, b, face.name);
      if (goes(b)) {
        left_at = crossing;
      } else if (crossing != left_at) {
        cap_edges_.emplace_back(crossing, left_at);
      }
      if (out.corners.empty() || out.corners.back() != crossing) out.corners.push_back(crossing);
    }
    return out;
  }

  /// The new faces: one in exact arithmetic. As many segments start at a vertex as end there, so every walk is closed.
  std::vector<Face> caps() {
    std::vector<Face> out;
    while (!cap_edges_.empty()) {
      Face cap = {{}, name_};
      const std::uint32_t start = cap_edges_.front().first;
      std::uint32_t at = start;
      do {
        const auto edge = std::find_if(cap_edges_.begin(), cap_edges_.end(),
                                       [&](const auto& candidate) { return candidate.first == at; });
        if (edge == cap_edges_.end()) break;
        cap.corners.push_back(at);
        at = edge->second;
        cap_edges_.erase(edge);
      } while (at != start);
      out.push_back(std::move(cap));
    }
    return out;
  }

 private:
  std::uint32_t crossing_of(std::uint32_t a, std::uint32_t b, std::int32_t face) {
    const auto [found, is_new] =
        crossings_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) {
      const double share = heights_[a] / (heights_[a] - heights_[b]);
      const Point& from = vertices_[a].position;
      const Point crossing = from + share * (vertices_[b].position - from);
      vertices_.push_back({crossing, {name_, face, face}});
      heights_.push_back(0);
    } else {
      vertices_[found->second].planes[2] = face;
    }
    return found->second;
  }

  std::vector<Vertex>& vertices_;
  std::int32_t name_;
  std::vector<double> heights_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cap_edges_;
};

void ClipPolytope::clip(const HalfSpace& half_space, std::int32_t name, double margin) {
  Cut cut(vertices_, half_space, name, margin);
  if (cut.cuts_nothing()) return;
  if (cut.cuts_all()) {
    vertices_.clear();
    faces_.clear();
    return;
  }
  std::vector<Face> faces;
  faces.reserve(faces_.size() + 1);
  // A face of two corners bounds nothing: the two faces beside it then share its edge.
  const auto keep = [&](Face face) {
    if (face.corners.size() > 2) faces.push_back(std::move(face));
  };
  for (const Face& face : faces_) keep(cut.clipped(face));
  for (Face& cap : cut.caps()) keep(std::move(cap));
  faces_ = std::move(faces);
  drop_unused_vertices();
}

void ClipPolytope::drop_unused_vertices() {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> new_index(vertices_.size(), kUnused);
  std::vector<Vertex> used;
  for (Face& face : faces_) {
    for (std::uint32_t& corner : face.corners) {
      if (new_index[corner] == kUnused) {
        new_index[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(vertices_[corner]);
      }
      corner = new_index[corner];
    }
  }
  vertices_ = std::move(used);
}

std::vector<HalfSpace> hull_half_spaces(const std::vector<Point>& points, double radius) {
  // The polar dual of the hull is { y : dot(p, y) <= 1 for all p }; its vertices are the facets' normals. Facets closer
  // than radius / 64 to the origin run into the box.
  const double half_side = 64 / radius;
  ClipPolytope dual(half_side);
  for (const Point& p : points) {
    const double distance = length(p);
    if (2 * distance * half_side < 1) continue;  // the plane misses the box
    dual.clip({(1 / distance) * p, 1 / distance}, 0, 0x1p-40 * half_side);
  }
  std::vector<HalfSpace> out;
  out.reserve(dual.vertices().size());
  for (const ClipPolytope::Vertex& y : dual.vertices()) {
    const Point normal = (1 / length(y.position)) * y.position;
    double offset = dot(normal, points.front());
    for (const Point& p : points) offset = std::max(offset, dot(normal, p));
    out.push_back({normal, offset});
  }
  return out;
}

}  // namespace medial_vk
