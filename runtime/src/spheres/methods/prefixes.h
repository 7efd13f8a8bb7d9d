// Sets of balls whose beginnings are good sets, too: their order, and what each beginning is worth.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"
#include "spheres/methods/sphere_set.h"

namespace medial_vk {

/// Puts the balls that matter most first: from the end, the ball with the least volume in its power cell among those
/// that are left goes next. The same balls give the same order on any number of `threads` (0: all). Errors: those of
/// ShrinkingUnion::build().
Status order_by_share(std::vector<Ball>& balls, unsigned threads = 0);

/// Volume of the union of the first k + 1 balls for every k, in mesh units cubed: the curve of volume against count.
/// Errors: those of ShrinkingUnion::build().
Result<std::vector<double>> prefix_volumes(std::span<const Ball> balls, unsigned threads = 0);

/// N, N/2, N/4 ... 1, the smallest first: how many balls each of the levels has.
std::vector<std::size_t> level_counts(std::size_t count);

}  // namespace medial_vk
