// Balls inside a solid that leave a gap no wider than a given distance, and covers that reach out no farther than it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// As few maximal balls inside the solid as the search finds that cover it, as prove_cover() proves, once each is grown
/// by `reach` (grown_balls()): then no point of the solid is farther from the balls inside than that, and the grown
/// balls reach out of the solid no farther (docs/theory.md, "Thin parts"). `for_cover`: points of the boundary are
/// balls of radius 0, too, where no ball inside is near, as on a surface that encloses nothing. `reach` is at least 16
/// Solid::rounding(). Deterministic for any number of threads. `report` gets the finished share, one call at a time.
/// `wanted`: a number of balls, 0 if any will do: the search ends early where it has no hope of so few. Throws
/// std::bad_alloc, and Stopped by `threads`. Errors: kUsage (more than kMostBalls balls, or many more than wanted; a
/// part thinner than rounding), kOutOfMemory, kInterrupted.
Result<std::vector<Ball>> spread_within(const Solid& solid, double reach, bool for_cover, std::size_t wanted,
                                        std::size_t most, const Threads& threads,
                                        const std::function<void(double)>& report = {});

/// Balls inside with the radius at which they reach out by `reach`: the distance of their centre from the boundary and
/// that, rounded down.
std::vector<Ball> grown_balls(const Solid& solid, const std::vector<Ball>& inside, double reach);

}  // namespace medial_vk
