// Verdicts and bounds for many poses on a device, compared with all pairs of balls, in double and without a tree.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/proximity.h"
#include "support/random_poses.h"

namespace medial_vk::test {

/// Bodies, and pairs of them in poses.
struct PosedBodies {
  std::vector<Body> bodies;
  std::vector<PosedPair> pairs;
  /// At least M, the sum of the distance of the bodies' middles and of their reaches, for every pair.
  double size = 0;
};

/// Balls inside, and balls of the same centres that cover them.
Body body_of(const std::vector<Ball>& inside);

std::vector<Ball> balls_at_random(Random& random, std::size_t count, const Point& middle, double size);

/// Bodies of 1 to 300 balls, at most some sizes apart.
PosedBodies bodies_at_random(Random& random, double size);

/// Balls at gaps about zero, far smaller and greater than the errors, at any place and in any direction: a kernel
/// without its errors would give proofs that are false.
PosedBodies balls_that_almost_touch(Random& random, double size);

/// What a device has answered.
struct DeviceAnswers {
  std::vector<Collision> verdicts;
  std::vector<DistanceBounds> bounds;
};

/// Both for all pairs, which must be proved, and as close as the kernel's errors allow.
DeviceAnswers expect_answers(Context& context, const PosedBodies& of);

/// How often each verdict is there, by its number.
std::array<int, 3> count_verdicts(std::span<const Collision> verdicts);

}  // namespace medial_vk::test
