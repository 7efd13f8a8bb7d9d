// The point of a triangle nearest to another point, in double, for triangles of any shape.
#pragma once

#include <array>

#include "base/point_ops.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A candidate for the nearest point, as a vector from the query point.
struct NearestOffset {
  double squared_distance;
  Point offset;
};

/// True only if the whole triangle is farther from p than the square root of `squared_limit`: it lies beyond the plane
/// at that distance across the direction s to its centre, since min over its corners of s.(corner - p) > limit |s|. It
/// takes a quarter of the work of nearest_on_triangle(), and excludes nearly all small triangles that are farther.
inline bool clearly_beyond(const Point& p, const std::array<Point, 3>& corners, double squared_limit) {
  const Point a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
  const Point s = a + b + c;
  // Each product has an error of at most 4 u |s| |corner - p|, u = 2^-53, which is below 1e-15 times the subtracted
  // terms.
  const double rounding = 1e-15 * (dot(s, s) + std::max({dot(a, a), dot(b, b), dot(c, c)}));
  const double least = std::min({dot(s, a), dot(s, b), dot(s, c)}) - rounding;
  return least > 0 && least * least > squared_limit * dot(s, s) * (1 + 1e-15);
}

/// Nearest point of the segment from `start` along `edge`, all relative to the query point.
inline NearestOffset nearest_on_segment(const Point& start, const Point& edge) {
  const double squared_length = dot(edge, edge);
  const double t = squared_length > 0 ? std::clamp(-dot(start, edge) / squared_length, 0.0, 1.0) : 0.0;
  const Point offset = start + t * edge;
  return {dot(offset, offset), offset};
}

/// The nearest of the points of the three edges and, if it lies inside, the foot of the perpendicular on the plane.
///
/// Accuracy. Every candidate is start + (a convex combination of the edges), a point of the triangle up to rounding,
/// so the distance is never below the exact one by more than a few u (u = 2^-53) of edge lengths and distance, for any
/// thin triangle. It is not far above it either. Let h be the part of ac perpendicular to ab, computed with an error of
/// about u |ac|; its direction is then off by e = u |ac| / |h|, and a foot computed from a vector r is off by e |r|
/// across the triangle. The second pass computes from the residual, whose length is about the distance D, so the foot
/// is off by e D at most. No point of the triangle is further than |h| from its edges, so where the foot is wrong or
/// wrongly found outside, the edges are within |h|. The squared distance is thus too large by at most
/// min(e D, |h|)^2 <= e D |h| = u D |ac|, the distance by u |ac| / 2.
inline NearestOffset nearest_on_triangle(const Point& p, const std::array<Point, 3>& corners) {
  const Point a = corners[0] - p;
  const Point b = corners[1] - p;
  const Point ab = corners[1] - corners[0];
  const Point ac = corners[2] - corners[0];
  NearestOffset best = nearest_on_segment(a, ab);
  for (const NearestOffset& other : {nearest_on_segment(a, ac), nearest_on_segment(b, corners[2] - corners[1])}) {
    if (other.squared_distance < best.squared_distance) best = other;
  }
  const double ab_ab = dot(ab, ab);
  if (!(ab_ab > 0)) return best;
  const Point h = ac - (dot(ac, ab) / ab_ab) * ab;
  const double h_h = dot(h, h);
  if (!(h_h > 0)) return best;
  double v = 0;
  double w = 0;
  Point residual = a;
  for (int pass = 0; pass < 2; ++pass) {
    const double dw = -dot(residual, h) / h_h;
    residual = residual + dw * ac;
    const double dv = -dot(residual, ab) / ab_ab;
    residual = residual + dv * ab;
    v += dv;
    w += dw;
  }
  const bool inside = v >= 0 && w >= 0 && v + w <= 1;
  const double squared_distance = dot(residual, residual);
  if (inside && squared_distance < best.squared_distance) best = {squared_distance, residual};
  return best;
}

}  // namespace medial_vk
