#include "outside_samples/outside_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>

#include "base/point_ops.h"
#include "base/split_mix.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kSeed = 7;

double cube(double x) { return x * x * x; }

/// In [0, 1).
double unit(SplitMix& random) { return 0.5 * (random.symmetric() + 1); }

/// Uniform on the unit sphere: height and angle are (Archimedes).
Point direction(SplitMix& random) {
  const double z = random.symmetric(), angle = std::numbers::pi * random.symmetric();
  const double across = std::sqrt(std::max(0.0, 1 - z * z));
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace

OutsideSamples::OutsideSamples(std::span<const Ball> balls, double protrusion, std::size_t count)
    : protrusion_(protrusion) {
  std::ranges::copy_if(balls, std::back_inserter(balls_), [](const Ball& ball) { return ball.radius > 0; });
  std::vector<double> sums;  // of the volumes of layers, up to each
  sums.reserve(balls_.size());
  for (const Ball& ball : balls_) {
    volume_ += 4 * std::numbers::pi / 3 * (cube(ball.radius) - cube(radius_inside(ball)));
    sums.push_back(volume_);
  }
  if (!(volume_ > 0)) return;
  points_.reserve(count);
  SplitMix random(kSeed);
  while (points_.size() < count) {
    const auto chosen = std::ranges::upper_bound(sums, unit(random) * volume_);
    const Ball& ball = balls_[static_cast<std::size_t>(std::min(chosen, std::prev(sums.end())) - sums.begin())];
    const double inner = cube(radius_inside(ball));
    const double radius = std::cbrt(inner + unit(random) * (cube(ball.radius) - inner));
    points_.push_back(ball.centre + radius * direction(random));
  }
}

double OutsideSamples::radius_inside(const Ball& ball) const { return std::max(0.0, ball.radius - protrusion_); }

/// 1 over the number of layers at a point of one; 0: a ball with less than its radius holds it, so that it is inside.
double OutsideSamples::weight(const Point& p) const {
  std::size_t layers = 0;
  for (const Ball& ball : balls_) {
    const double distance = length(p - ball.centre);
    if (distance < radius_inside(ball)) return 0;
    layers += distance <= ball.radius ? 1 : 0;
  }
  return 1 / static_cast<double>(std::max<std::size_t>(1, layers));  // rounding may leave it out of its own
}

OutsideEstimate OutsideSamples::estimate(std::span<const double> depths) const {
  if (points_.empty()) return {};
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!(depths[i] < 0)) continue;
    const double w = weight(points_[i]);
    sum += w;
    squares += w * w;
  }
  const auto count = static_cast<double>(points_.size());
  if (!(sum > 0)) return {0, 3 * volume_ / count};
  const double mean = sum / count, variance = std::max(0.0, squares / count - mean * mean);
  return {volume_ * mean, volume_ * std::sqrt(variance / count)};
}

}  // namespace medial_vk
