// Triangles of the boundary, and parts of them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {

/// A triangle or a part of one.
struct TrianglePart {
  std::array<Point, 3> corner;

  Point middle() const { return (1.0 / 3) * (corner[0] + (corner[1] + corner[2])); }
  /// Of length 1, or 0 without an area.
  Point normal() const {
    const Point twice = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double size = length(twice);
    return size > 0 ? (1 / size) * twice : Point{};
  }
  /// The greatest distance of its points from `from`.
  double reach(const Point& from) const {
    return std::max({length(corner[0] - from), length(corner[1] - from), length(corner[2] - from)});
  }
};

/// Appends the four parts between the middles of the sides.
inline void split_part(const TrianglePart& part, std::vector<TrianglePart>& parts) {
  const auto& [a, b, c] = part.corner;
  const Point ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  parts.insert(parts.end(), {{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}});
}

}  // namespace medial_vk
