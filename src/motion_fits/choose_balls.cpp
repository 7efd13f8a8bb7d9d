#include "motion_fits/choose_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "medial_vk/dynamic_union.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNoSlot = 0xffffffffu;
/// Exchanges end when the value grows by less than this share of it.
constexpr double kLeastGrowth = 1e-6;

double volume_of(const Ball& ball) { return 4 * std::numbers::pi / 3 * ball.radius * ball.radius * ball.radius; }

bool overlap(const Ball& a, const Ball& b) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) squared += (a.centre[k] - b.centre[k]) * (a.centre[k] - b.centre[k]);
  const double reach = a.radius + b.radius;
  return squared < reach * reach;
}

/// A failed change of a union ends the choice.
struct ChoiceFault {
  Error error;
};

template <class T>
T value_or_fault(Result<T> result) {
  if (!result) throw ChoiceFault{result.error()};
  return std::move(result).value();
}

/// The chosen candidates in one frame.
class ChosenInFrame {
 public:
  ChosenInFrame(const CandidateFrame& frame, std::uint32_t capacity)
      : frame_(&frame),
        union_(value_or_fault(DynamicUnion::build(capacity, largest_of(frame)))),
        slots_(frame.balls.size(), kNoSlot),
        losses_(frame.balls.size()) {}

  double gain(std::uint32_t candidate) {
    const Ball& ball = frame_->balls[candidate];
    return ball.radius > 0 ? frame_->weight * value_or_fault(union_.gain(ball)) : 0;
  }

  void add(std::uint32_t candidate) {
    const Ball& ball = frame_->balls[candidate];
    if (!(ball.radius > 0)) return;
    slots_[candidate] = value_or_fault(union_.add(ball));
    forget_losses_at(ball);
  }

  void remove(std::uint32_t candidate) {
    const std::uint32_t slot = std::exchange(slots_[candidate], kNoSlot);
    if (slot == kNoSlot) return;
    if (const Status status = union_.remove(slot); !status) throw ChoiceFault{status.error()};
    forget_losses_at(frame_->balls[candidate]);
  }

  /// Of a chosen candidate.
  double loss(std::uint32_t candidate) {
    if (slots_[candidate] == kNoSlot) return 0;
    std::optional<double>& known = losses_[candidate];
    if (!known) known = frame_->weight * value_or_fault(union_.loss(slots_[candidate]));
    return *known;
  }

  double value() const { return frame_->weight * union_.volume(); }
  const CandidateFrame& frame() const { return *frame_; }

 private:
  static double largest_of(const CandidateFrame& frame) {
    double largest = std::numeric_limits<double>::min();
    for (const Ball& ball : frame.balls) {
      if (!(ball.radius > 0)) continue;
      largest = std::max(largest, ball.radius);
      for (const double x : ball.centre) largest = std::max(largest, std::fabs(x));
    }
    return largest;
  }

  /// What a ball adds depends on all balls that overlap it, also on hidden ones, which have an empty power cell:
  /// DynamicUnion::changed() does not name the balls that hide one.
  void forget_losses_at(const Ball& ball) {
    for (std::size_t c = 0; c < losses_.size(); ++c) {
      if (losses_[c] && overlap(frame_->balls[c], ball)) losses_[c].reset();
    }
  }

  const CandidateFrame* frame_;
  DynamicUnion union_;
  std::vector<std::uint32_t> slots_;           // by candidate
  std::vector<std::optional<double>> losses_;  // by candidate, of those that are chosen
};

class BallChoice {
 public:
  BallChoice(std::span<const CandidateFrame> frames, const ChoiceOptions& options) : options_(options) {
    // One more than are chosen, during an exchange.
    for (const CandidateFrame& frame : frames) {
      frames_.emplace_back(frame, static_cast<std::uint32_t>(options.count) + 1);
    }
    const std::size_t candidates = frames.front().balls.size();
    is_chosen_.resize(candidates);
    bounds_.resize(candidates);
    known_at_.resize(candidates);
    for (std::size_t c = 0; c < candidates; ++c) {
      for (const CandidateFrame& frame : frames) bounds_[c] += frame.weight * volume_of(frame.balls[c]);
    }
  }

  Result<MotionChoice> choose(const std::vector<std::uint32_t>& start) {
    for (const std::uint32_t candidate : start) add(candidate);
    while (chosen_.size() < options_.count) {
      if (!goes_on(0.5 * static_cast<double>(chosen_.size()) / static_cast<double>(options_.count))) return stopped();
      const std::optional<std::uint32_t> best = best_candidate();
      if (!best) break;
      add(*best);
    }
    // Most exchanges are among the first; each candidate is exchanged twice at most, on average.
    const std::size_t most = 2 * options_.count;
    for (std::size_t i = 0; i < most; ++i) {
      if (!goes_on(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(most))) return stopped();
      if (!exchange()) break;
    }
    return MotionChoice{chosen_, value()};
  }

 private:
  static Error stopped() { return {ErrorCode::kInterrupted, "the choice of balls was stopped"}; }
  bool goes_on(double done) const { return options_.goes_on(done); }

  double value() const {
    double sum = 0;
    for (const ChosenInFrame& frame : frames_) sum += frame.value();
    return sum;
  }

  /// The gain of a candidate only shrinks as others are chosen, so that an old one is an upper bound: those with the
  /// greatest bounds are measured until one that is up to date is the greatest. No value: none adds volume.
  std::optional<std::uint32_t> best_candidate() {
    while (true) {
      std::uint32_t best = kNoSlot;
      for (std::uint32_t c = 0; c < bounds_.size(); ++c) {
        if (is_chosen_[c] == 0 && bounds_[c] > 0 && (best == kNoSlot || bounds_[c] > bounds_[best])) best = c;
      }
      if (best == kNoSlot) return std::nullopt;
      if (known_at_[best] == changes_) return best;
      double gain = 0;
      for (ChosenInFrame& frame : frames_) gain += frame.gain(best);
      bounds_[best] = gain;
      known_at_[best] = changes_;
    }
  }

  void add(std::uint32_t candidate) {
    for (ChosenInFrame& frame : frames_) frame.add(candidate);
    is_chosen_[candidate] = 1;
    chosen_.push_back(candidate);
    ++changes_;
  }

  /// Without the candidate, another one that overlaps it gains more than before: by its loss at most.
  void remove(std::uint32_t candidate) {
    for (ChosenInFrame& in_frame : frames_) {
      const double loss = in_frame.loss(candidate);
      const std::vector<Ball>& balls = in_frame.frame().balls;
      for (std::size_t c = 0; c < balls.size(); ++c) {
        if (loss > 0 && overlap(balls[c], balls[candidate])) bounds_[c] += loss;
      }
      in_frame.remove(candidate);
    }
    is_chosen_[candidate] = 0;
    bounds_[candidate] = std::numeric_limits<double>::infinity();
    std::erase(chosen_, candidate);
    ++changes_;
  }

  /// Adds the best candidate, and removes the one that adds least then. False: the value has not grown.
  bool exchange() {
    const std::optional<std::uint32_t> best = best_candidate();
    if (!best) return false;
    const double gain = bounds_[*best];
    add(*best);
    const auto [least, loss] = least_of_chosen();
    remove(least);
    return least != *best && gain - loss > kLeastGrowth * value();
  }

  std::pair<std::uint32_t, double> least_of_chosen() {
    std::vector<std::vector<double>> losses(frames_.size());
    parallel_for(frames_.size(), 1, options_.threads, [&](std::size_t f) {
      for (const std::uint32_t c : chosen_) losses[f].push_back(frames_[f].loss(c));
    });
    std::pair<std::uint32_t, double> least = {kNoSlot, std::numeric_limits<double>::infinity()};
    for (std::size_t i = chosen_.size(); i-- > 0;) {  // of equal ones the last, which has been added
      double loss = 0;
      for (const std::vector<double>& in_frame : losses) loss += in_frame[i];
      if (loss < least.second) least = {chosen_[i], loss};
    }
    return least;
  }

  const ChoiceOptions& options_;
  std::vector<ChosenInFrame> frames_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint8_t> is_chosen_;  // by candidate
  std::vector<double> bounds_;           // by candidate, of its gain
  std::vector<std::uint64_t> known_at_;  // by candidate: its bound is its gain after so many changes
  std::uint64_t changes_ = 1;
};

}  // namespace

Result<MotionChoice> choose_balls(std::span<const CandidateFrame> frames, const std::vector<std::uint32_t>& start,
                                  const ChoiceOptions& options) {
  const std::size_t candidates = frames.front().balls.size();
  if (candidates == 0 || candidates > (std::size_t{1} << 30)) {
    return Error{ErrorCode::kUsage, "the number of balls to choose from must be from 1 to 2^30"};
  }
  try {
    ChoiceOptions limited = options;
    limited.count = std::min(options.count, candidates);
    return BallChoice(frames, limited).choose(start);
  } catch (const ChoiceFault& fault) {
    return fault.error;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory to choose balls"};
  }
}

}  // namespace medial_vk
