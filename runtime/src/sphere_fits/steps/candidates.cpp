#include "sphere_fits/steps/candidates.h"

#include <numbers>

namespace medial_vk {

void Candidates::add(std::span<const Ball> balls) {
  for (const Ball& ball : balls) {
    const double volume = 4 * std::numbers::pi / 3 * ball.radius * ball.radius * ball.radius;
    queue_.push({volume, static_cast<std::uint32_t>(balls_.size()), round_});
    balls_.push_back(ball);
  }
}

Result<std::optional<Candidates::Choice>> Candidates::take_best(DynamicUnion& balls) {
  ++round_;
  while (!queue_.empty()) {
    const Entry best = queue_.top();
    if (best.evaluated == round_) {
      if (best.gain == 0) break;  // all remain candidates, as balls may move away from them
      queue_.pop();
      return std::optional<Choice>({balls_[best.candidate], best.gain});
    }
    const Result<double> gain = balls.gain(balls_[best.candidate]);
    if (!gain) return gain.error();
    queue_.pop();
    queue_.push({gain.value(), best.candidate, round_});
  }
  return std::optional<Choice>();
}

}  // namespace medial_vk
