// The nearest points of two triangles, in double.
#pragma once

#include <array>

#include "base/point_ops.h"

namespace medial_vk {

using Corners = std::array<Point, 3>;

/// Points of two triangles, and what they prove.
struct TrianglePoints {
  Point on_a = {0, 0, 0}, on_b = {0, 0, 0};
  double distance = 0;   ///< Between the two points.
  bool crosses = false;  ///< The triangles have a point in common, whatever the rounding; both points are near it.
  Point direction{};     ///< A unit vector from a to b across which they are farthest apart; null: none is known.
  double apart = 0;      ///< separation_along() this direction.
};

/// `direction` is a unit vector. The points of a are all on one side of a plane across `direction`, those of b beyond a
/// parallel one: the distance between the planes, and so no more than that between the triangles. It is negative if the
/// planes are in the other order. Computed relative to `origin`, which is best near the triangles.
double separation_along(const Corners& a, const Corners& b, const Point& direction, const Point& origin);

/// The nearest points of two triangles, which may be of any shape, up to rounding: the points belong to the triangles
/// to within 2^-50 of their coordinates. `error` bounds the distance of each corner from where it would be without
/// rounding; only crossings that no such error can undo count. `direction` is that between the points. Where their
/// rounding makes it too coarse, as between points that nearly touch, it is the best of the normals of both faces and
/// of each two edges, of which one is right for faces, and for edges that are not parallel.
TrianglePoints nearest_points(const Corners& a, const Corners& b, double error);

}  // namespace medial_vk
