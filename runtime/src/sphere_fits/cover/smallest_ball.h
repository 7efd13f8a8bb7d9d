// The smallest ball around points.
#pragma once

#include <span>

#include "medial_vk/ball.h"

namespace medial_vk {

/// The smallest ball that holds all points, at least one; its radius is the greatest computed distance from its centre
/// to one of them, so it is never too small, and too large by rounding only (relative 1e-10 at most). Time: a few
/// passes over the points.
Ball smallest_ball(std::span<const Point> points);

}  // namespace medial_vk
