// The distance between two rectangles in space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/eight_floats.h"
#include "base/point_ops.h"
#include "medial_vk/pose.h"
#include "swept_rectangle.h"

namespace medial_vk::bench {

/// Exact up to rounding. One of the nearest points of two rectangles can be taken from an edge: if they meet, an end of
/// what they share is on an edge; else, if neither point is on one, the planes are parallel, and both points can be
/// moved together until one reaches an edge. So the distance is the least one between an edge of either rectangle and
/// the other rectangle. These are computed four at a time.
class RectangleDistance {
 public:
  RectangleDistance(const SweptRectangle& a, const SweptRectangle& b, const Pose& pose) : a_(a), b_(b) {
    for (std::size_t k = 0; k < 2; ++k) turned_[k] = in_axes_of_a(rotated(pose, b.axes[k]));
    turned_[2] = cross(turned_[0], turned_[1]);
    corner_ = in_axes_of_a(rotated(pose, b.corner) + pose.shift - a.corner);
  }

  double value() const { return std::sqrt(std::min(least_square(edges_of_b(), a_), least_square(edges_of_a(), b_))); }

 private:
  using FourDoubles = double __attribute__((vector_size(32)));

  /// The edges of one rectangle in the frame of the other, whose corner is at 0 and whose sides are along x and y: the
  /// points from + t along, for t from 0 to 1.
  struct Edges {
    std::array<FourDoubles, 3> from, along;
  };

  static Point rotated(const Pose& pose, const Point& p) {
    return {dot(pose.rotation[0], p), dot(pose.rotation[1], p), dot(pose.rotation[2], p)};
  }
  Point in_axes_of_a(const Point& p) const { return {dot(a_.axes[0], p), dot(a_.axes[1], p), dot(a_.axes[2], p)}; }

  Edges edges_of_b() const { return edges(corner_, b_.sides[0] * turned_[0], b_.sides[1] * turned_[1]); }
  Edges edges_of_a() const {
    Point corner, first, second;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = -dot(turned_[k], corner_);
      first[k] = a_.sides[0] * turned_[k][0];
      second[k] = a_.sides[1] * turned_[k][1];
    }
    return edges(corner, first, second);
  }

  static Edges edges(const Point& corner, const Point& first, const Point& second) {
    Edges all;
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = corner[k], u = first[k], v = second[k];
      all.from[k] = FourDoubles{c, c + v, c, c + u};
      all.along[k] = FourDoubles{u, u, v, v};
    }
    return all;
  }

  /// What a coordinate lacks of the interval from 0 to `side`.
  MEDIAL_VK_INLINE static FourDoubles beyond(const FourDoubles& x, double side) {
    const FourDoubles zero = {};
    return x < zero ? x : x > side ? x - side : zero;
  }

  MEDIAL_VK_INLINE static FourDoubles at(const Edges& edges, std::size_t k, const FourDoubles& t) {
    return edges.from[k] + t * edges.along[k];
  }

  /// Half of the change of the squared distance with t: it never falls, and is linear between the crossings of the
  /// lines along the sides.
  MEDIAL_VK_INLINE static FourDoubles slope(const Edges& edges, const std::array<double, 2>& sides,
                                            const FourDoubles& t) {
    return edges.along[0] * beyond(at(edges, 0, t), sides[0]) + edges.along[1] * beyond(at(edges, 1, t), sides[1]) +
           edges.along[2] * at(edges, 2, t);
  }

  static double least_square(const Edges& edges, const SweptRectangle& rectangle) {
    const std::array<double, 2>& sides = rectangle.sides;
    const FourDoubles zero = {}, one = zero + 1;
    // The least squared distance is at 0, at 1, or between two crossings between which the slope passes 0.
    FourDoubles below = zero, above = one;
    FourDoubles slope_below = slope(edges, sides, zero), slope_above = slope(edges, sides, one);
    const auto narrow = [&](FourDoubles t) __attribute__((always_inline)) {
      t = t > zero ? t : zero;  // also where an edge is parallel to the line
      t = t < one ? t : one;
      const FourDoubles s = slope(edges, sides, t);
      const auto is_below = (s < zero) & (t > below), is_above = (s >= zero) & (t < above);
      below = is_below ? t : below;
      slope_below = is_below ? s : slope_below;
      above = is_above ? t : above;
      slope_above = is_above ? s : slope_above;
    };
    for (std::size_t k = 0; k < 2; ++k) {
      narrow(-edges.from[k] / edges.along[k]);
      narrow((sides[k] - edges.from[k]) / edges.along[k]);
    }
    const FourDoubles between = below - (above - below) * slope_below / (slope_above - slope_below);
    FourDoubles t = slope_above > zero ? between : above;
    t = slope_below < zero ? t : below;
    const FourDoubles x = beyond(at(edges, 0, t), sides[0]), y = beyond(at(edges, 1, t), sides[1]), z = at(edges, 2, t);
    const FourDoubles squares = x * x + y * y + z * z;
    return std::min({squares[0], squares[1], squares[2], squares[3]});
  }

  const SweptRectangle& a_;
  const SweptRectangle& b_;
  std::array<Point, 3> turned_;  // the axes of b in those of a
  Point corner_;                 // of b, in the frame of a
};

}  // namespace medial_vk::bench
