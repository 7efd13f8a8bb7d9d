#include "sheets/significance.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "sheets/sheets_around.h"

namespace medial_vk {
namespace {

std::vector<std::vector<std::uint32_t>> balls_by_sheet(const SheetBalls& sheets) {
  std::vector<std::vector<std::uint32_t>> balls(sheets.sheets);
  for (std::uint32_t i = 0; i < sheets.sheet_of.size(); ++i) {
    balls[static_cast<std::size_t>(sheets.sheet_of[i])].push_back(i);
  }
  return balls;
}

bool goes_first(const std::vector<double>& of_sheet, std::uint32_t a, std::uint32_t b) {
  if (of_sheet[a] != of_sheet[b]) return of_sheet[a] < of_sheet[b];
  return a > b;
}

/// Ascending.
std::vector<std::uint32_t> by_significance(const std::vector<double>& of_sheet) {
  std::vector<std::uint32_t> order(of_sheet.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return goes_first(of_sheet, a, b); });
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
    for (std::size_t removed = order_.size(); removed != removal_.sheets.size() && !too_little_;) {
      removed = removal_.sheets.size();
      for (State& state : state_) {
        if (state == State::kStays) state = State::kNotTried;
      }
      if (const Status status = remove_least_first(); !status.ok()) return status.error();
      if (!keeps_topology_) break;
    }
    for (std::size_t n = order_.size(); n-- > 0;) {
      if (state_[order_[n]] != State::kGone) removal_.kept.push_back(order_[n]);
    }
    return std::move(removal_);
  }

 private:
  enum class State : std::uint8_t { kNotTried, kStays, kGone };

  /// Whether a sheet may be removed depends mostly on its surroundings: a sheet that had to stay is tried again, before
  /// all more significant ones, when cells of its balls have changed.
  Status remove_least_first() {
    for (std::size_t n = 0; n < order_.size() && removal_.sheets.size() + 1 < order_.size();) {
      const std::uint32_t sheet = order_[n++];
      if (state_[sheet] != State::kNotTried) continue;
      if (!progress_(done())) return Error{ErrorCode::kInterrupted, "interrupted"};
      if (Status status = try_to_remove(sheet); !status.ok()) return status;
      if (too_little_) return {};
      if (state_[sheet] == State::kStays) continue;
      for (const std::uint32_t ball : rest_.changed()) {
        State& state = state_[static_cast<std::size_t>(sheet_of_[ball])];
        if (state != State::kStays) continue;
        state = State::kNotTried;
        n = 0;
      }
    }
    return {};
  }

  /// The finished share of past and certain future trials: the untried sheets, and with kTopology a last round over all
  /// that stay.
  double done() {
    std::size_t ahead = 0;
    for (const State state : state_) {
      if (state == State::kNotTried) ++ahead;
      if (state != State::kGone && keeps_topology_) ++ahead;
    }
    const auto tried = static_cast<double>(tries_++);
    done_ = std::max(done_, tried / (tried + static_cast<double>(ahead)));
    return done_;
  }

  Result<bool> may_go() const {
    if (!keeps_topology_) return true;
    const Result<BettiNumbers> left = rest_.betti();
    if (!left) return left.error();
    return left.value() == topology_;
  }

  Status try_to_remove(std::uint32_t sheet) {
    if (Status status = rest_.remove(balls_[sheet]); !status.ok()) return status;
    const double volume = rest_.volume();
    const Result<bool> goes = may_go();
    if (!goes) return goes.error();
    too_little_ = goes.value() && !(volume >= least_volume_);
    if (!goes.value() || too_little_) {
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
  bool too_little_ = false;  // the next removal would leave less than the least volume
  std::size_t tries_ = 0;
  double done_ = 0;
};

std::vector<double> sum_by_sheet(const SheetBalls& sheets, const std::vector<double>& of_ball) {
  std::vector<double> of_sheet(sheets.sheets);
  for (std::size_t i = 0; i < of_ball.size(); ++i) of_sheet[static_cast<std::size_t>(sheets.sheet_of[i])] += of_ball[i];
  return of_sheet;
}

/// Assigns the amount of a ball to the sheets around it; where there is none other than its own, to its own.
void give(const SheetBalls& sheets, std::uint32_t index, double amount, double weight, const SheetsAround& around,
          SheetsAround::Given& to) {
  const Ball& ball = sheets.balls[index];
  const std::int32_t own = sheets.sheet_of[index];
  const double reach = std::max(kSeamReach * ball.radius, 2 * sheets.voxel_size);
  const bool is_divided = !(weight > 0) || around.others_near(ball.centre, reach, own);
  if (is_divided && around.divide(amount, ball.centre, reach, to)) return;
  to.sheets[static_cast<std::size_t>(own)] += amount;
}

/// In voxel order, for any order of the balls, and in the same number of parts for any number of cores: sums do not
/// depend on either. Precondition: there is a graph.
std::vector<double> share_among_sheets(const SheetBalls& sheets, const std::vector<double>& of_ball, unsigned threads) {
  constexpr std::size_t kParts = 16;
  const std::size_t count = of_ball.size();
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t position = 0; position < count; ++position) order[position] = sheets.graph->index(position);
  std::vector<double> weights(sheets.weights.begin(), sheets.weights.end());
  if (weights.empty()) weights.assign(count, 1);
  const SheetsAround around(sheets.balls, sheets.sheet_of, weights, sheets.sheets, order);
  std::vector<SheetsAround::Given> given(kParts);
  parallel_for(kParts, 1, threads, [&](std::size_t part) {
    given[part] = around.nothing();
    for (std::size_t position = part * count / kParts; position < (part + 1) * count / kParts; ++position) {
      give(sheets, order[position], of_ball[order[position]], weights[order[position]], around, given[part]);
    }
  });
  for (std::size_t part = 1; part < kParts; ++part) given[0].add(given[part]);
  return around.by_sheet(given[0]);
}

/// Decreasing. Balls of radius 0 and hidden balls are in no component.
Result<std::vector<double>> share_among_components(const BallUnion& whole) {
  const Result<std::vector<std::uint32_t>> component_of = component_of_vertices(whole.complex);
  if (!component_of) return component_of.error();
  std::vector<double> shares;
  for (std::size_t i = 0; i < whole.complex.vertices.size(); ++i) {
    shares.resize(std::max<std::size_t>(shares.size(), component_of.value()[i] + std::size_t{1}));
    shares[component_of.value()[i]] += whole.volumes[whole.complex.vertices[i]];
  }
  std::ranges::sort(shares, std::greater<>());
  for (double& share : shares) share = whole.volume > 0 ? share / whole.volume : 0;
  return shares;
}

}  // namespace

std::vector<double> seam_weights(const Sheets& sheets) {
  std::vector<double> weights = sheets.areas;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (sheets.marks[i] & kSmall) weights[i] = 0;
  }
  return weights;
}

Result<Significance> measure_significance(const SheetBalls& sheets, unsigned threads) {
  for (const std::int32_t sheet : sheets.sheet_of) {
    if (sheet < 0 || static_cast<std::size_t>(sheet) >= sheets.sheets) {
      return Error{ErrorCode::kInternal, "a ball is in sheet " + std::to_string(sheet) + ", which does not exist"};
    }
  }
  if (!sheets.weights.empty() && sheets.weights.size() != sheets.balls.size()) {
    return Error{ErrorCode::kInternal, std::to_string(sheets.balls.size()) + " balls have " +
                                           std::to_string(sheets.weights.size()) + " weights"};
  }
  Result<BallUnion> measured = measure_ball_union(sheets.balls, {.threads = threads, .complex = true});
  if (!measured) return measured.error();
  BallUnion& whole = measured.value();
  const Result<BettiNumbers> topology = betti_numbers(whole.complex);
  if (!topology) return topology.error();
  Result<std::vector<double>> of_component = share_among_components(whole);
  if (!of_component) return of_component.error();
  Significance result{.volume = whole.volume,
                      .area = whole.area,
                      .topology = topology.value(),
                      .of_component = std::move(of_component).value(),
                      .of_ball = std::move(whole.volumes),
                      .of_sheet = {},
                      .areas = std::move(whole.areas)};
  for (std::size_t i = 0; i < result.of_ball.size(); ++i) {
    if (result.volume > 0) result.of_ball[i] /= result.volume;
  }
  result.of_sheet =
      sheets.graph ? share_among_sheets(sheets, result.of_ball, threads) : sum_by_sheet(sheets, result.of_ball);
  return result;
}

Result<SheetRemoval> remove_sheets(const SheetBalls& sheets, const Significance& significance, RemovalRule rule,
                                   double least_volume, unsigned threads, const RemovalProgress& progress) {
  Result<ShrinkingUnion> whole = ShrinkingUnion::build(sheets.balls, {.threads = threads});
  if (!whole) return whole.error();
  return Removing(sheets, significance, rule, least_volume, progress, std::move(whole).value()).run();
}

SheetRemoval stop_at_volume(SheetRemoval removal, const Significance& significance, double least_volume) {
  const auto first = std::ranges::find_if(removal.volume_left, [&](double left) { return !(left >= least_volume); });
  const auto count = static_cast<std::size_t>(first - removal.volume_left.begin());
  removal.kept.insert(removal.kept.end(), removal.sheets.begin() + static_cast<std::ptrdiff_t>(count),
                      removal.sheets.end());
  removal.sheets.resize(count);
  removal.volume_left.resize(count);
  std::sort(removal.kept.begin(), removal.kept.end(),
            [&](std::uint32_t a, std::uint32_t b) { return goes_first(significance.of_sheet, b, a); });
  return removal;
}

}  // namespace medial_vk
