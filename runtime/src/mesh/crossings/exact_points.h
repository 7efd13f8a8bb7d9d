// Points where edges and triangles cross, in exact arithmetic: decisions about them never contradict each other.
//
// The coordinates of vertices are integers of at most 50 bits times 2^-49 (snap_to_grid()). A point where an edge
// crosses a plane, or three planes cross, is a quotient of polynomials of them; it is kept as homogeneous coordinates,
// each of which is an expansion. The largest polynomial, of degree 20, is a multiple of 2^-980, so nothing underflows.
#pragma once

#include <array>
#include <vector>

#include "base/expansion.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// x, y, z and w > 0, exactly: the point is (x / w, y / w, z / w). `near` is within 2^-50 of each coordinate.
struct ExactPoint {
  std::array<std::vector<double>, 4> terms;
  Point near{};
};

/// The corners of a triangle, on the grid.
using GridTriangle = std::array<Point, 3>;

/// The axis along which the triangle is projected best.
int projection_axis(const GridTriangle& triangle);

/// Rounds to a multiple of 2^-49, for coordinates in [-1, 1].
Point snap_to_grid(const Point& p);

/// Predicates return the exact sign: -1, 0 or 1. For one thread at a time.
class ExactGeometry {
 public:
  ExactGeometry() : math_(arena_) {}

  ExactPoint vertex(const Point& p);
  /// The point where the line through u and v crosses the plane of the triangle. Precondition: u and v are on different
  /// sides of it.
  ExactPoint on_line(const Point& u, const Point& v, const GridTriangle& triangle);
  /// The point where three planes cross; no coordinate may be read if it returns false: two of them are parallel, or
  /// all three share a direction.
  bool on_planes(const std::array<GridTriangle, 3>& triangles, ExactPoint& point);

  /// Positive if d is in front of the triangle (a, b, c), which is counter-clockwise seen from there.
  int side(const Point& a, const Point& b, const Point& c, const Point& d);
  /// Positive if p, q, r are counter-clockwise in the plane of axes `axis` + 1 and `axis` + 2.
  int orientation(const ExactPoint& p, const ExactPoint& q, const ExactPoint& r, int axis);
  /// Of a component of the normal of the triangle.
  int normal_sign(const GridTriangle& triangle, int axis);

 private:
  using Vector = std::array<Expansion, 3>;

  Vector difference(const Point& a, const Point& b);
  Vector cross(const Vector& a, const Vector& b);
  Expansion dot(const Vector& a, const Vector& b);
  Expansion product(Expansion a, Expansion b) { return math_.compressed(math_.product(a, b)); }
  Expansion sum(Expansion a, Expansion b) { return math_.compressed(math_.sum(a, b)); }
  Expansion difference(Expansion a, Expansion b) { return math_.compressed(math_.difference(a, b)); }
  ExactPoint finish(std::array<Expansion, 4> terms);

  ExpansionArena arena_;
  ExpansionMath math_;
};

}  // namespace medial_vk
