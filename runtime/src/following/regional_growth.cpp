#include "following/regional_growth.h"

#include <algorithm>
#include <numeric>

namespace medial_vk {
namespace {

/// By which factor a region grows before another attempt, which takes the time of several frames.
constexpr double kFurther = 1.25;

/// Balls that have been drawn to rest lie 1e-10 of the longest side away from there, which changes distances of a
/// thousandth of it or more by less than this share of them.
constexpr double kNearRest = 1 + 1e-6;

}  // namespace

RegionalGrowth::RegionalGrowth(const MovingSurface& surface, std::span<const Ball> balls, double volume, double factor)
    : samples_(surface, balls),
      most_(samples_.regions()),
      tried_(samples_.regions(), 0),
      chosen_(samples_.regions(), 0) {
  samples_.prepare(balls);
  for (std::uint32_t region = 0; region < most_.size(); ++region) {
    samples_.tighten(surface, region);
    most_[region] = share(region, volume);
  }
  samples_.keep_for_rest();
  const double mean = std::accumulate(most_.begin(), most_.end(), 0.0) / static_cast<double>(most_.size());
  for (double& most : most_) most = kNearRest * factor * std::max(most, mean);
}

bool RegionalGrowth::has_grown(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                               WorkerPool& pool) {
  samples_.bound(surface, balls, pool);
  bool is_prepared = false;
  for (std::uint32_t region = 0; region < most_.size(); ++region) {
    if (!(share(region, volume) > most_[region])) continue;
    if (!is_prepared) samples_.prepare(balls);
    is_prepared = true;
    samples_.tighten(surface, region);
    if (share(region, volume) > most_[region]) return true;
  }
  return false;
}

bool RegionalGrowth::choose(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                            WorkerPool& pool) {
  samples_.bound(surface, balls, pool);
  bool is_prepared = false;
  for (std::uint32_t region = 0; region < most_.size(); ++region) {
    chosen_[region] = 0;
    const double most = std::max(most_[region], kFurther * tried_[region]);
    if (share(region, volume) > most) {
      if (!is_prepared) samples_.prepare(balls);
      is_prepared = true;
      samples_.tighten(surface, region);
      chosen_[region] = share(region, volume) > most ? 1 : 0;
    }
    if (share(region, volume) <= most_[region]) tried_[region] = 0;
  }
  return std::ranges::find(chosen_, std::uint8_t{1}) != chosen_.end();
}

void RegionalGrowth::choose_all() { std::ranges::fill(chosen_, std::uint8_t{1}); }

void RegionalGrowth::tried(const MovingSurface& surface, std::span<const Ball> balls, double volume) {
  samples_.prepare(balls);
  for (std::uint32_t region = 0; region < most_.size(); ++region) {
    if (chosen_[region] == 0) continue;
    samples_.tighten(surface, region);
    tried_[region] = share(region, volume);
  }
}

void RegionalGrowth::return_to_rest() {
  samples_.return_to_rest();
  std::ranges::fill(tried_, 0.0);
  std::ranges::fill(chosen_, std::uint8_t{0});
}

}  // namespace medial_vk
