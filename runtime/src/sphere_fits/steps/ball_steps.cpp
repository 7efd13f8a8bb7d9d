#include "sphere_fits/steps/ball_steps.h"

#include <algorithm>

namespace medial_vk {

Result<double> BallSteps::take(DynamicUnion& balls, std::uint32_t slot, double& step) {
  // In radii: a ball whose step is shorter has converged.
  constexpr double kLongestStep = 0.5, kShortestStep = 1e-3;
  if (step < kShortestStep * balls.ball(slot).radius) return 0.0;
  const Result<std::optional<Ball>> proposed = propose(balls, slot, step);
  if (!proposed.ok()) return proposed.error();
  const std::optional<Ball>& to = proposed.value();
  if (!to) {
    step /= 4;
    return 0.0;
  }
  const Result<double> gain = try_move(balls, slot, *to);
  if (!gain) return gain.error();
  step = gain.value() > 0 ? std::min(1.3 * step, kLongestStep * to->radius) : step / 2;
  return gain.value();
}

}  // namespace medial_vk
