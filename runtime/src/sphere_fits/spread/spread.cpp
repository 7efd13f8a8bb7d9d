#include "sphere_fits/spread/spread.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kPlaces = 16384;
constexpr int kRoundsOfTop = 16;

/// 1, 2, 3 ... 8, 10, 12, 14, 16, 20 ...
bool is_top(std::size_t count) {
  std::size_t step = 1;
  while (count >= 8 * step) step *= 2;
  return count % step == 0;
}

/// The largest ball that is found: at points of the boundary, then by steps of its centre to larger ones.
Ball large_ball(const Solid& solid) {
  constexpr std::size_t kSamples = 512;
  Ball largest = {};
  for (const BoundarySample& sample : places_of(solid, kSamples)) {
    std::optional<Ball> ball;
    double depth = 1e-3 * solid.diagonal();
    while (!ball && depth > 4 * solid.rounding()) {
      ball = maximal_through(solid, sample.at + depth * sample.inward);
      depth /= 4;
    }
    if (ball && ball->radius > largest.radius) largest = *ball;
  }
  double step = 0.5 * largest.radius;
  while (step > 1e-3 * largest.radius) {
    const Ball before = largest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Point to = before.centre;
        to[axis] += sign * step;
        const std::optional<Ball> ball = maximal_through(solid, to);
        if (ball && ball->radius > largest.radius) largest = *ball;
      }
    }
    if (!(largest.radius > before.radius * (1 + 1e-6))) step /= 2;
  }
  return largest;
}

}  // namespace

BallSpread::BallSpread(const Solid& solid, const Threads& threads)
    : search_(solid, places_of(solid, kPlaces), threads) {}

void BallSpread::grow(std::size_t count) {
  // The search may have gone back to fewer balls, or been stopped within a step.
  if (gaps_.size() < count && (is_within_step_ || search_.balls().size() != gaps_.size())) go_to(gaps_.size());
  while (gaps_.size() < count && !ends_) {
    is_within_step_ = true;
    ends_ = !search_.insert();
    if (ends_) break;
    const std::size_t size = search_.balls().size();
    if (is_top(size)) {
      search_.improve(kRoundsOfTop);
      tops_[size] = search_.balls();
    }
    gaps_.push_back(search_.reachable_gap());
    is_within_step_ = false;
  }
}

/// To a number of balls that there have been.
void BallSpread::go_to(std::size_t count) {
  const auto after = tops_.upper_bound(count);
  search_.restore(after == tops_.begin() ? std::vector<Ball>() : std::prev(after)->second);
  while (search_.balls().size() < count && search_.insert()) {
  }
}

std::vector<Ball> BallSpread::of(std::size_t count) {
  grow(count);
  count = std::min(count, gaps_.size());
  if (is_within_step_ || search_.balls().size() != count) go_to(count);
  is_within_step_ = false;
  return search_.balls();
}

std::vector<double> BallSpread::gaps(std::size_t count) {
  grow(count);
  return {gaps_.begin(), gaps_.begin() + static_cast<std::ptrdiff_t>(std::min(count, gaps_.size()))};
}

std::size_t sparse_count(const Solid& solid) {
  if (!solid.has_volume() || !(solid.volume() > 0)) return 0;
  const double radius = large_ball(solid).radius;
  if (!(radius > 0)) return 0;
  const double volume = 4 * std::numbers::pi / 3 * radius * radius * radius;
  return static_cast<std::size_t>(std::min(0.5 * solid.volume() / volume, 1e9));
}

}  // namespace medial_vk
