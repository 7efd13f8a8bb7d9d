// Few of many balls that follow a motion, so that their unions are large in all frames together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Where all candidates are in one frame; radius 0: lost. In every frame they are in the same order.
struct CandidateFrame {
  std::vector<Ball> balls;
  double weight = 1;  ///< Positive: of the volume of the union in this frame.
};

struct ChoiceOptions {
  std::size_t count = 1;  ///< The most candidates that are chosen.
  unsigned threads = 0;   ///< 0: one per core. The result does not depend on it.
  /// Called with the finished share; returns false to stop.
  std::function<bool(double)> goes_on = [](double) { return true; };
};

/// The chosen candidates, by index, and the value that they have: the sum over the frames of weight times the volume of
/// the union.
struct MotionChoice {
  std::vector<std::uint32_t> chosen;
  double value = 0;
};

/// Adds to `start`, which has at most `count` candidates, those with the greatest gains of value one by one, and then
/// exchanges chosen candidates for others while the value grows. It is never less than that of `start`, and from an
/// empty one it is at least 1 - 1/e of the greatest that is possible. `frames` is not empty. Errors: kUsage (no
/// candidate, or more than 2^30), kOutOfMemory, kInterrupted.
Result<MotionChoice> choose_balls(std::span<const CandidateFrame> frames, const std::vector<std::uint32_t>& start,
                                  const ChoiceOptions& options);

}  // namespace medial_vk
