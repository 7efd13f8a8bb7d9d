// Cavities between balls that cover a closed surface.
#pragma once

#include <vector>

#include "following/moving_surface.h"
#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Balls that hold every triangle of a closed surface, at least one of a positive radius. Some grow, and some of radius
/// 0 are placed anew, until every point with a winding number other than 0 is held. False: that is not proved.
/// Deterministic. Throws std::bad_alloc. Errors: those of measure_ball_union().
Result<bool> fill_cavities(const MovingSurface& surface, std::vector<Ball>& balls, unsigned threads);

}  // namespace medial_vk
