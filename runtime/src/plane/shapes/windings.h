// The winding numbers on both sides of each edge of an arrangement.
#pragma once

#include <vector>

#include "plane/shapes/arrangement.h"

namespace medial_vk::plane {

struct EdgeWindings {
  std::int64_t left = 0, right = 0;  ///< Of the edge from its first end to its second.
};

/// By a sweep over the plane (M. I. Shamos and D. Hoey, "Geometric Intersection Problems", 1976). Throws
/// std::bad_alloc.
std::vector<EdgeWindings> windings(const Arrangement& arrangement);

}  // namespace medial_vk::plane
