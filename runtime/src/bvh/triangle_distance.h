// The point of a triangle nearest to another point, in double, for triangles of any shape.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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

/// Weights of two edges of a triangle, and the vector from the query point to the corner plus these shares of the
/// edges.
struct WeightedOffset {
  double v, w;
  Point offset;

  bool is_inside() const { return v >= 0 && w >= 0 && v + w <= 1; }
};

/// The foot of the perpendicular on the plane of a triangle with a corner at `a`, relative to the query point, and the
/// edges `ab` and `ac`, whose part across ab is `h`. Where it is not inside, it may be inexact.
///
/// A pass finds the weights of the residual offset. h has an error of about u |ac| (u = 2^-53), its direction one of
/// e = u |ac| / |h|, and a pass divides the error of the weights by 1 / e. Weights of size W are rounded, which leaves
/// an error of u W along ab, and e times that across it, in the next pass. So the rest is below the last correction and
/// e^2 times the one before, both of which tell when enough is known; the code takes 8 e for e. If that is the case
/// after two passes, and the foot is inside, the weights of the first pass were below 2, so the sums in the offset have
/// few roundings of lengths of edges; later passes begin with an offset that is computed anew from the weights.
inline WeightedOffset foot_on_plane(const Point& a, const Point& ab, const Point& ac, const Point& h, double ab_ab,
                                    double h_h) {
  constexpr double kSmallCorrection = 0x1p-44;
  constexpr int kMostPasses = 12;
  const double squared_e = 0x1p-100 * dot(ac, ac) / h_h;
  WeightedOffset foot = {0, 0, a};
  double last = 0;
  for (int pass = 1;; ++pass) {
    const double dw = -dot(foot.offset, h) / h_h;
    foot.offset = foot.offset + dw * ac;
    const double dv = -dot(foot.offset, ab) / ab_ab;
    foot.offset = foot.offset + dv * ab;
    foot.v += dv;
    foot.w += dw;
    const double correction = std::fabs(dv) + std::fabs(dw);
    const double margin = correction + squared_e * last;
    last = correction;
    if (pass == 1) continue;
    const bool is_outside = foot.v < -margin || foot.w < -margin || foot.v + foot.w > 1 + margin;
    if (is_outside || correction <= kSmallCorrection) return foot;
    foot.offset = a + foot.v * ab + foot.w * ac;
    if (pass == kMostPasses) return foot;
  }
}

/// The nearest of the points of the three edges and, if it lies inside, the foot of the perpendicular on the plane.
///
/// Accuracy. Every candidate is start + (a convex combination of the edges), a point of the triangle up to rounding,
/// so the distance is never below the exact one by more than a few u (u = 2^-53) of edge lengths and distance, for any
/// thin triangle. It is not far above it either. Let L be the longest edge and e = u |ac| / |h| the error of a
/// direction in foot_on_plane(). No point of the triangle is farther than |h| from its edges, so where a foot is wrong
/// or wrongly found outside, the edges are within |h|. The weights of a foot that is returned after a small correction
/// c are off by about e c, and those of one that follows from an exact offset of length D by e D / L: the foot is off
/// by s = e (D + c L) across the triangle. The squared distance is thus too large by at most min(s, |h|)^2 <= s |h| = u
/// |ac| (D + c L), and the distance by u |ac| / 2 + sqrt(u c) L, with sqrt(u c) <= 2^-48. Corrections that are still
/// not small in the last pass shrink by a factor of less than 2^5 a pass: then |h| < 2^5 u |ac|.
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
  const WeightedOffset foot = foot_on_plane(a, ab, ac, h, ab_ab, h_h);
  const double squared_distance = dot(foot.offset, foot.offset);
  if (foot.is_inside() && squared_distance < best.squared_distance) best = {squared_distance, foot.offset};
  return best;
}

}  // namespace medial_vk
