// Several closest-point queries near one another: the triangles around them are gathered once, and the queries then
// test no others. Triangles are named by their positions among the leaves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

/// Replaces `positions` by the leaf positions of all triangles within `radius` of `centre`, and of some triangles
/// beyond. Throws std::bad_alloc.
void gather_within(const Bvh& bvh, const Point& centre, double radius, std::vector<std::uint32_t>& positions);

/// Replaces `leaves` by the indices in Bvh::nodes() of all leaves whose boxes reach within `radius` of `centre`. Throws
/// std::bad_alloc.
void gather_leaves(const Bvh& bvh, const Point& centre, double radius, std::vector<std::uint32_t>& leaves);

/// As Bvh::closest(), among the triangles at these leaf positions, and `best`: the nearest point of triangles tested
/// before.
BvhHit closest_of(const Bvh& bvh, const Point& p, std::span<const std::uint32_t> positions, BvhHit best = {});

/// The index in `positions` of the first triangle closer to p than `radius` (positive), or positions.size() if there is
/// none.
std::size_t find_within(const Bvh& bvh, const Point& p, double radius, const std::vector<std::uint32_t>& positions);

inline double squared_distance(const BvhBox& box, const Point& p) {
  const Point outside = greatest(greatest(box.lower - p, p - box.upper), Point{0, 0, 0});
  return dot(outside, outside);
}

/// Makes the triangle at a leaf position the best hit if it is nearer, or equally near and of a smaller index.
inline void improve_hit(const Bvh& bvh, const Point& p, std::uint32_t position, BvhHit& best) {
  const std::array<Point, 3>& corners = bvh.corners()[position];
  if (clearly_beyond(p, corners, best.squared_distance)) return;
  const NearestOffset nearest = nearest_on_triangle(p, corners);
  const std::uint32_t triangle = bvh.order()[position];
  const bool tie = nearest.squared_distance == best.squared_distance && best.triangle != 0xffffffffu;
  if (nearest.squared_distance < best.squared_distance || (tie && triangle < best.triangle)) {
    best = {nearest.squared_distance, p + nearest.offset, triangle};
  }
}

}  // namespace medial_vk
