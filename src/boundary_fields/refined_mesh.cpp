#include "boundary_fields/refined_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace medial_vk {
namespace {

class EdgeHalver {
 public:
  EdgeHalver(std::vector<Point>& vertices, double longest_edge) : vertices_(vertices), longest_edge_(longest_edge) {}

  /// Appends the parts of a triangle of which edges are halved.
  void cut(const Triangle& t, std::vector<Triangle>& parts) {
    std::array<std::uint32_t, 3> middles{};  // Of the edges from corner i to the next one.
    std::size_t count = 0, last = 0, whole = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      middles[i] = middle_of(t[i], t[(i + 1) % 3]);
      if (middles[i] == kNone) {
        whole = i;
      } else {
        ++count;
        last = i;
      }
    }
    if (count == 0) parts.push_back(t);
    if (count == 1) cut_in_two(t, last, middles[last], parts);
    if (count == 2) cut_in_three(t, whole, middles, parts);
    if (count == 3) {
      for (std::size_t i = 0; i < 3; ++i) parts.push_back({t[i], middles[i], middles[(i + 2) % 3]});
      parts.push_back({middles[0], middles[1], middles[2]});
    }
  }

  bool has_halved() const { return !middles_.empty(); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  double length(std::uint32_t a, std::uint32_t b) const {
    const Point& p = vertices_[a];
    const Point& q = vertices_[b];
    return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
  }

  /// kNone: the edge is short enough.
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    if (!(length(a, b) > longest_edge_)) return kNone;
    const auto [least, greatest] = std::minmax(a, b);
    const auto [found, is_new] = middles_.try_emplace(std::uint64_t{least} << 32 | greatest, kNone);
    if (is_new) {
      Point middle{};
      for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = vertices_[least][k] + (vertices_[greatest][k] - vertices_[least][k]) / 2;
      }
      found->second = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(middle);
    }
    return found->second;
  }

  static void cut_in_two(const Triangle& t, std::size_t edge, std::uint32_t middle, std::vector<Triangle>& parts) {
    const std::uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3];
    parts.push_back({a, middle, c});
    parts.push_back({middle, b, c});
  }

  /// The edge from corner `whole` stays; the quadrilateral on it is cut along the shorter diagonal.
  void cut_in_three(const Triangle& t, std::size_t whole, const std::array<std::uint32_t, 3>& middles,
                    std::vector<Triangle>& parts) const {
    const std::uint32_t a = t[whole], b = t[(whole + 1) % 3], c = t[(whole + 2) % 3];
    const std::uint32_t beside_b = middles[(whole + 1) % 3], beside_a = middles[(whole + 2) % 3];
    parts.push_back({beside_a, beside_b, c});
    if (length(a, beside_b) < length(b, beside_a)) {
      parts.push_back({a, b, beside_b});
      parts.push_back({a, beside_b, beside_a});
    } else {
      parts.push_back({a, b, beside_a});
      parts.push_back({b, beside_b, beside_a});
    }
  }

  std::vector<Point>& vertices_;
  double longest_edge_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // By the numbers of both ends.
};

}  // namespace

Mesh refine_mesh(const Mesh& mesh, double longest_edge) {
  Mesh refined = mesh;
  for (bool has_halved = true; has_halved;) {
    EdgeHalver halver(refined.vertices, longest_edge);
    std::vector<Triangle> parts;
    parts.reserve(refined.triangles.size());
    for (const Triangle& t : refined.triangles) halver.cut(t, parts);
    refined.triangles = std::move(parts);
    has_halved = halver.has_halved();
  }
  return refined;
}

}  // namespace medial_vk
