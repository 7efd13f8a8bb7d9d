// Balls inside a solid that cannot grow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"

namespace medial_vk {

/// Grows the largest empty ball around `inside`, a point of the solid, away from its contact until it touches the
/// boundary a second time (the shrinking ball of J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using
/// nearest neighbors and the normal field", 2012). The result holds `inside`, so its centre lies in the solid; its
/// radius is at most the exact distance of its centre. Radius 0 or below: the distance of the point to the boundary is
/// below rounding.
Ball maximal_ball(const Solid& solid, const Point& inside);
/// The same, faster if one of these triangles limits the ball, such as those that limited a ball next to it; others
/// that do are appended.
Ball maximal_ball(const Solid& solid, const Point& inside, std::vector<std::uint32_t>& triangles);

/// The nearest point of the boundary, found faster if it lies on one of these triangles.
BvhHit closest_with(const Solid& solid, const Point& p, std::span<const std::uint32_t> triangles);

}  // namespace medial_vk
