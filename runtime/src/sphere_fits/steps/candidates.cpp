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

/// Removes the candidates with the greatest old gains, at most kAtOnce, from the queue: those before one whose gain is
/// known.
void Candidates::take_stale(std::vector<Entry>& stale) {
  constexpr std::size_t kAtOnce = 16;
  stale.clear();
  while (!queue_.empty() && queue_.top().evaluated != round_ && stale.size() < kAtOnce) {
    stale.push_back(queue_.top());
    queue_.pop();
  }
}

Result<std::optional<Candidates::Choice>> Candidates::take_best(DynamicUnion& balls) {
  ++round_;
  std::vector<Entry> stale;
  std::vector<Ball> tried;
  for (take_stale(stale); !stale.empty(); take_stale(stale)) {
    tried.clear();
    for (const Entry& entry : stale) tried.push_back(balls_[entry.candidate]);
    const Result<std::vector<double>> gains = balls.gains(tried);
    if (gains.ok()) {
      for (std::size_t i = 0; i < stale.size(); ++i) stale[i] = {gains.value()[i], stale[i].candidate, round_};
    }
    for (const Entry& entry : stale) queue_.push(entry);
    if (!gains.ok()) return gains.error();
  }
  // Without a gain, all remain candidates, as balls may move away from them.
  if (queue_.empty() || queue_.top().gain == 0) return std::optional<Choice>();
  const Entry best = queue_.top();
  queue_.pop();
  return std::optional<Choice>({balls_[best.candidate], best.gain});
}

}  // namespace medial_vk
