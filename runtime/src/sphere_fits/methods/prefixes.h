// Orders of balls whose prefixes are also good sets, and the volume of each prefix.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"
#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Orders balls by importance: from the end, the next ball is the one with the least volume in its power cell among the
/// remaining ones. The order is the same for any number of `threads` (0: one per core). Errors: those of
/// ShrinkingUnion::build().
Status order_by_share(std::vector<Ball>& balls, unsigned threads = 0);

/// Volume of the union of the first k + 1 balls for every k, in mesh units cubed: the curve of volume against count.
/// Errors: those of ShrinkingUnion::build().
Result<std::vector<double>> prefix_volumes(std::span<const Ball> balls, unsigned threads = 0);

/// N, N/2, N/4 ... 1, the smallest first: the numbers of balls of the levels.
std::vector<std::size_t> level_counts(std::size_t count);

}  // namespace medial_vk
