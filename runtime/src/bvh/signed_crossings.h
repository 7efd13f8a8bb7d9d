// How often a closed surface winds around a point, by the triangles that a ray from the point crosses.
#pragma once

#include <cstdint>
#include <optional>

#include "medial_vk/bvh.h"

namespace medial_vk {

/// The sum over all triangles that the ray from `p` crosses: 1 where it leaves through the front of one, -1 where it
/// enters. If every edge is traversed equally often in both directions, this is the winding number at `p`, even where
/// triangles cross or coincide (docs/theory.md, "Winding numbers by rays"). No component of `direction` is 0. No value:
/// rounding leaves a sign open, because the ray passes an edge, or `p` lies on a triangle.
std::optional<std::int64_t> signed_crossings(const Bvh& bvh, const Point& p, const Point& direction);

}  // namespace medial_vk
