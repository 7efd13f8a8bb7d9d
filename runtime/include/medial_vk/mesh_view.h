// The form in which a caller passes a triangle mesh to the library: borrowed arrays, which are copied only when an
// IndexedMesh is built.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace medial_vk {

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

/// Properties of one triangle, derived from its neighbourhood (docs/theory.md, Lemma B: dismissal requires an oriented,
/// embedded boundary).
enum TriangleFlags : std::uint8_t {
  /// All edges and vertices of the triangle are manifold, its neighbours agree in orientation, no other triangle
  /// crosses it, the inside lies behind it and the outside in front: its outward normal is trusted.
  kTrustedNormal = 1u << 0,
  /// Other triangles meet it only in a vertex or an edge that they share by index. kTrustedNormal implies this
  /// property, whether or not this flag is set.
  kUncrossed = 1u << 1,
};

/// A side of the boundary: inside are the points whose winding number is at least 1/2 (docs/theory.md, "The
/// complement").
enum class MeshSide : std::uint8_t { kInside, kOutside };

/// A borrowed triangle mesh. Triangles are counter-clockwise seen from outside. No triangle may be degenerate, all
/// coordinates must be finite, every index must be below vertices.size().
struct MeshView {
  std::span<const Point> vertices;
  std::span<const Triangle> triangles;
  /// One TriangleFlags value per triangle, or empty: then no normal is trusted.
  std::span<const std::uint8_t> flags;
  /// True if every edge is shared by triangles whose orientations cancel: the winding number is then an integer away
  /// from the boundary, and whole cells can be decided to lie inside or outside.
  bool closed = false;
};

}  // namespace medial_vk
