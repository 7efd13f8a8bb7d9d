#include "sphere_fits/steps/candidates.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Candidates that are measured at once, on all threads.
constexpr std::size_t kAtOnce = 16;

double volume_of(const Ball& ball) { return 4 * std::numbers::pi / 3 * ball.radius * ball.radius * ball.radius; }

}  // namespace

void Candidates::note_shrunk(std::span<const Ball> before) {
  for (std::size_t candidate = 0; candidate < balls_.size(); ++candidate) {
    const Ball& ball = balls_[candidate];
    const bool met = std::any_of(before.begin(), before.end(), [&](const Ball& other) {
      return length(other.centre - ball.centre) < other.radius + ball.radius;
    });
    if (met && bounds_[candidate] != kTaken) bounds_[candidate] = volume_of(ball);
  }
  queue_ = by_bounds();
}

void Candidates::add(std::span<const Ball> balls) {
  for (const Ball& ball : balls) {
    const double volume = volume_of(ball);
    queue_.push({volume, static_cast<std::uint32_t>(balls_.size()), round_});
    balls_.push_back(ball);
    bounds_.push_back(volume);
  }
}

void Candidates::find_promising(const Coverage& coverage) {
  ++round_;
  promising_.clear();
  while (!queue_.empty() && queue_.top().gain > 0 && promising_.size() < kAtOnce) {
    const Entry top = queue_.top();
    queue_.pop();
    if (bounds_[top.candidate] == kTaken) continue;
    if (top.evaluated == round_) {
      promising_.push_back(top);
    } else {
      queue_.push({coverage.uncovered(balls_[top.candidate]), top.candidate, round_});
    }
  }
  for (const Entry& entry : promising_) queue_.push(entry);
}

/// Gives these their exact gains.
Status Candidates::measure(DynamicUnion& balls, std::vector<Entry>& entries) {
  std::vector<Ball> tried;
  tried.reserve(entries.size());
  for (const Entry& entry : entries) tried.push_back(balls_[entry.candidate]);
  const Result<std::vector<double>> gains = balls.gains(tried);
  if (!gains.ok()) return gains.error();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Entry& entry = entries[i];
    entry.gain = bounds_[entry.candidate] = gains.value()[i];
    entry.evaluated = round_;
  }
  return {};
}

Candidates::Choice Candidates::take(const Entry& best) {
  bounds_[best.candidate] = kTaken;
  return {balls_[best.candidate], best.gain};
}

Result<std::optional<Candidates::Choice>> Candidates::take_best(DynamicUnion& balls) {
  std::vector<Entry> promising = std::exchange(promising_, {});
  if (Status status = measure(balls, promising); !status.ok()) return status.error();
  const auto best = std::max_element(promising.begin(), promising.end());
  if (best == promising.end() || best->gain == 0) return take_best_of_all(balls);
  return std::optional<Choice>(take(*best));
}

Candidates::Queue Candidates::by_bounds() const {
  std::vector<Entry> entries;
  for (std::uint32_t candidate = 0; candidate < balls_.size(); ++candidate) {
    if (bounds_[candidate] != kTaken) entries.push_back({bounds_[candidate], candidate, round_});
  }
  return Queue({}, std::move(entries));
}

/// Estimates may be too low, gains that have been measured hardly ever are. Without a gain, all remain candidates, as
/// balls may move away from them.
Result<std::optional<Candidates::Choice>> Candidates::take_best_of_all(DynamicUnion& balls) {
  Queue queue = by_bounds();
  ++round_;
  std::vector<Entry> stale;
  while (!queue.empty() && queue.top().evaluated != round_) {
    stale.clear();
    for (; !queue.empty() && queue.top().evaluated != round_ && stale.size() < kAtOnce; queue.pop()) {
      stale.push_back(queue.top());
    }
    if (Status status = measure(balls, stale); !status.ok()) return status.error();
    for (const Entry& entry : stale) queue.push(entry);
  }
  if (queue.empty() || queue.top().gain == 0) return std::optional<Choice>();
  return std::optional<Choice>(take(queue.top()));
}

}  // namespace medial_vk
