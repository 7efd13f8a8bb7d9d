// A direction from a point of the boundary into the solid, or out of it, in which large balls are likely.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/thickness.h"
#include "solid/solid.h"

namespace medial_vk {

/// A unit vector that makes small angles with the normals of all triangles within `radius` of p, turned to the side of
/// the balls. `nearby` is memory for the call.
Point direction_of_balls(const Solid& solid, const Point& p, double radius, ThicknessSide side,
                         std::vector<std::uint32_t>& nearby);

}  // namespace medial_vk
