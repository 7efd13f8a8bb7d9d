#include "hull_fits/search/uncovered_seeds.h"

#include <algorithm>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostBalls = 4096;

/// A point of the ball, at random.
Point point_in(const Ball& ball, SplitMix& random) {
  for (;;) {
    Point offset;
    for (double& x : offset) x = random.symmetric();
    if (dot(offset, offset) <= 1) return ball.centre + ball.radius * offset;
  }
}

}  // namespace

UncoveredSeeds::UncoveredSeeds(std::span<const Ball> medial) { take(medial, {}); }

void UncoveredSeeds::take(std::span<const Ball> balls, std::span<const BallHull> hulls) {
  const std::size_t stride = std::max<std::size_t>(1, (balls.size() + kMostBalls - 1) / kMostBalls);
  balls_.clear();
  balls_.reserve(balls.size() / stride + 1);
  for (std::size_t i = 0; i < balls.size(); i += stride) balls_.push_back(balls[i]);
  points_.clear();
  points_.reserve(balls_.size() * kPoints);
  SplitMix random(1);
  for (const Ball& ball : balls_) {
    for (std::size_t k = 0; k < kPoints; ++k) points_.push_back(point_in(ball, random));
  }
  holders_.assign(points_.size(), 0);
  sums_.assign(balls_.size(), 0);
  for (const BallHull& hull : hulls) add(hull);
  update();
}

void UncoveredSeeds::count(const BallHull& hull, int change) {
  const HullBounds box = bounds_of(hull);
  const AxisQuery query(hull);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& p = points_[i];
    bool beside = false;
    for (std::size_t k = 0; k < 3; ++k) beside = beside || p[k] < box.lower[k] || p[k] > box.upper[k];
    if (!beside && query.distance(p) <= 0) holders_[i] += change;
  }
}

void UncoveredSeeds::update() {
  double sum = 0;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    std::size_t free = 0;
    for (std::size_t k = 0; k < kPoints; ++k) free += holders_[i * kPoints + k] == 0 ? 1 : 0;
    sum += balls_[i].radius * static_cast<double>(free);
    sums_[i] = sum;
  }
}

const Ball& UncoveredSeeds::draw(SplitMix& random) const {
  const double at = 0.5 * (random.symmetric() + 1) * sums_.back();
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
  return balls_[std::min<std::size_t>(static_cast<std::size_t>(found - sums_.begin()), balls_.size() - 1)];
}

}  // namespace medial_vk
