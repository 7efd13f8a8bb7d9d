#include "sheets/significance.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace medial_vk {
namespace {

std::vector<std::vector<std::uint32_t>> balls_by_sheet(const SheetBalls& sheets) {
  std::vector<std::vector<std::uint32_t>> balls(sheets.sheets);
  for (std::uint32_t i = 0; i < sheets.sheet_of.size(); ++i) {
    balls[static_cast<std::size_t>(sheets.sheet_of[i])].push_back(i);
  }
  return balls;
}

/// Ascending.
std::vector<std::uint32_t> by_significance(const std::vector<double>& of_sheet) {
  std::vector<std::uint32_t> order(of_sheet.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return of_sheet[a] < of_sheet[b] || (of_sheet[a] == of_sheet[b] && a > b);
  });
  return order;
}

class Removing {
 public:
  Removing(const SheetBalls& sheets, const Significance& significance, RemovalRule rule, double least_volume,
           const RemovalProgress& progress, ShrinkingUnion rest)
      : sheet_of_(sheets.sheet_of),
        balls_(balls_by_sheet(sheets)),
        whole_(significance.volume),
        least_volume_(least_volume * significance.volume),
        keeps_topology_(rule == RemovalRule::kTopology),
        progress_(progress),
        rest_(std::move(rest)),
        order_(by_significance(significance.of_sheet)),
        state_(sheets.sheets, State::kNotTried),
        topology_(significance.topology) {}

  Result<SheetRemoval> run() {
    // The last round finds nothing to remove.
    for (std::size_t removed = order_.size(); removed != removal_.sheets.size();) {
      removed = removal_.sheets.size();
      for (State& state : state_) {
        if (state == State::kStays) state = State::kNotTried;
      }
      if (const Status status = remove_least_first(); !status.ok()) return status.error();
      if (!keeps_topology_) break;
    }
    for (auto sheet = order_.rbegin(); sheet != order_.rend(); ++sheet) {
      if (state_[*sheet] != State::kGone) removal_.kept.push_back(*sheet);
    }
    return std::move(removal_);
  }

 private:
  enum class State : std::uint8_t { kNotTried, kStays, kGone };

  /// Whether a sheet may go depends for the most part on what is around it: one that had to stay is tried again, before
  /// all that are more significant, when cells of its balls have changed.
  Status remove_least_first() {
    for (std::size_t n = 0; n < order_.size() && removal_.sheets.size() + 1 < order_.size();) {
      const std::uint32_t sheet = order_[n++];
      if (state_[sheet] != State::kNotTried) continue;
      if (!progress_(done())) return Error{ErrorCode::kInterrupted, "interrupted"};
      if (const Status status = try_to_remove(sheet); !status.ok()) return status;
      if (state_[sheet] == State::kStays) {
        if (!keeps_topology_) return {};  // the order is that of Section 6.3, whatever a later sheet would leave
        continue;
      }
      for (const std::uint32_t ball : rest_.changed()) {
        State& state = state_[static_cast<std::size_t>(sheet_of_[ball])];
        if (state != State::kStays) continue;
        state = State::kNotTried;
        n = 0;
      }
    }
    return {};
  }

  double done() const {
    return static_cast<double>(removal_.sheets.size()) / static_cast<double>(std::max<std::size_t>(balls_.size(), 1));
  }

  Result<bool> keeps_enough(double volume) const {
    if (!(volume >= least_volume_)) return false;
    if (!keeps_topology_) return true;
    const Result<BettiNumbers> left = rest_.betti();
    if (!left) return left.error();
    return left.value() == topology_;
  }

  Status try_to_remove(std::uint32_t sheet) {
    if (Status status = rest_.remove(balls_[sheet]); !status.ok()) return status;
    const double volume = rest_.volume();
    const Result<bool> keeps = keeps_enough(volume);
    if (!keeps) return keeps.error();
    if (!keeps.value()) {
      rest_.undo();
      state_[sheet] = State::kStays;
      return {};
    }
    state_[sheet] = State::kGone;
    removal_.sheets.push_back(sheet);
    removal_.volume_left.push_back(whole_ > 0 ? volume / whole_ : 1);
    return {};
  }

  std::span<const std::int32_t> sheet_of_;
  std::vector<std::vector<std::uint32_t>> balls_;
  double whole_, least_volume_;
  bool keeps_topology_;
  const RemovalProgress& progress_;
  ShrinkingUnion rest_;
  std::vector<std::uint32_t> order_;  // by increasing significance
  std::vector<State> state_;
  BettiNumbers topology_;
  SheetRemoval removal_;
};

}  // namespace

Result<Significance> measure_significance(const SheetBalls& sheets, unsigned threads) {
  for (const std::int32_t sheet : sheets.sheet_of) {
    if (sheet < 0 || static_cast<std::size_t>(sheet) >= sheets.sheets) {
      return Error{ErrorCode::kInternal, "a ball is in sheet " + std::to_string(sheet) + ", which there is not"};
    }
  }
  Result<BallUnion> measured = measure_ball_union(sheets.balls, {.threads = threads, .complex = true});
  if (!measured) return measured.error();
  BallUnion& whole = measured.value();
  const Result<BettiNumbers> topology = betti_numbers(whole.complex);
  if (!topology) return topology.error();
  Significance result{.volume = whole.volume,
                      .area = whole.area,
                      .topology = topology.value(),
                      .of_ball = std::move(whole.volumes),
                      .of_sheet = std::vector<double>(sheets.sheets),
                      .areas = std::move(whole.areas)};
  for (std::size_t i = 0; i < result.of_ball.size(); ++i) {
    if (result.volume > 0) result.of_ball[i] /= result.volume;
    result.of_sheet[static_cast<std::size_t>(sheets.sheet_of[i])] += result.of_ball[i];
  }
  return result;
}

Result<SheetRemoval> remove_sheets(const SheetBalls& sheets, const Significance& significance, RemovalRule rule,
                                   double least_volume, unsigned threads, const RemovalProgress& progress) {
  Result<ShrinkingUnion> whole = ShrinkingUnion::build(sheets.balls, threads);
  if (!whole) return whole.error();
  return Removing(sheets, significance, rule, least_volume, progress, std::move(whole).value()).run();
}

}  // namespace medial_vk
