#include "following/regional_growth.h"

#include <algorithm>
#include <numeric>

namespace medial_vk {
namespace {

/// The growth that is worth an attempt, which takes the time of several frames, as a share of all that is uncovered in
/// the rest pose.
constexpr double kLeastGrowth = 0.05;

}  // namespace

RegionalGrowth::RegionalGrowth(const MovingSurface& surface, std::span<const Ball> balls, double volume, double factor)
    : samples_(surface, balls),
      factor_(factor),
      rest_(samples_.regions()),
      tried_(samples_.regions(), 0),
      chosen_(samples_.regions(), 0) {
  samples_.prepare(balls);
  for (std::uint32_t region = 0; region < rest_.size(); ++region) {
    samples_.tighten(surface, region);
    rest_[region] = samples_.volume(region) / volume;
  }
  samples_.keep_for_rest();
  least_ = kLeastGrowth * std::accumulate(rest_.begin(), rest_.end(), 0.0);
}

/// Of a region that has grown by more than the factor, beyond what is known of it; else 0.
double RegionalGrowth::growth(std::uint32_t region, double known, double volume) const {
  const double share = samples_.volume(region) / volume;
  return share > factor_ * rest_[region] ? std::max(0.0, share - std::max(known, rest_[region])) : 0;
}

/// Upper bounds decide first: in most frames nothing has grown.
bool RegionalGrowth::choose_beyond(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                                   std::span<const double> known, WorkerPool& pool) {
  samples_.bound(surface, balls, pool);
  std::ranges::fill(chosen_, std::uint8_t{0});
  double sum = 0;
  for (std::uint32_t region = 0; region < rest_.size(); ++region) sum += growth(region, known[region], volume);
  if (!(sum > least_)) return false;
  samples_.prepare(balls);
  sum = 0;
  for (std::uint32_t region = 0; region < rest_.size(); ++region) {
    if (!(growth(region, known[region], volume) > 0)) continue;
    samples_.tighten(surface, region);
    const double grown = growth(region, known[region], volume);
    chosen_[region] = grown > 0 ? 1 : 0;
    sum += grown;
  }
  return sum > least_;
}

bool RegionalGrowth::has_grown(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                               WorkerPool& pool) {
  return choose_beyond(surface, balls, volume, rest_, pool);
}

bool RegionalGrowth::choose(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                            WorkerPool& pool) {
  const bool is_any = choose_beyond(surface, balls, volume, tried_, pool);
  for (std::uint32_t region = 0; region < rest_.size(); ++region) {
    if (samples_.volume(region) <= factor_ * rest_[region] * volume) tried_[region] = 0;
  }
  return is_any;
}

void RegionalGrowth::choose_all() { std::ranges::fill(chosen_, std::uint8_t{1}); }

void RegionalGrowth::tried(const MovingSurface& surface, std::span<const Ball> balls, double volume) {
  samples_.prepare(balls);
  for (std::uint32_t region = 0; region < rest_.size(); ++region) {
    if (chosen_[region] == 0) continue;
    samples_.tighten(surface, region);
    tried_[region] = samples_.volume(region) / volume;
  }
}

void RegionalGrowth::return_to_rest() {
  samples_.return_to_rest();
  std::ranges::fill(tried_, 0.0);
  std::ranges::fill(chosen_, std::uint8_t{0});
}

}  // namespace medial_vk
