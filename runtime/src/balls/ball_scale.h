// Balls as the exact predicates want them: numbers up to 1.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/queries.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// kUsage if a number is not finite, a radius is negative, or there are too many balls.
Status check_balls(std::span<const Ball> balls);

struct ScaledBalls {
  std::vector<Ball> balls;  ///< Scaled and rounded to multiples of 2^-150, so that products of five of them are exact.
  double unit = 1;          ///< A power of two: what 1 was before.
};
ScaledBalls scale_balls(std::span<const Ball> balls);

/// The sum with the rounding errors of its additions carried along (A. Neumaier, 1974), so that it does not wear out.
double careful_sum(std::span<const double> terms);

}  // namespace medial_vk
