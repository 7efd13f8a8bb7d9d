#include "following/watched_points.h"

#include <algorithm>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostMiddles = 20000;
constexpr std::uint32_t kHeldByNone = 0xffffffffu;

}  // namespace

WatchedPoints::WatchedPoints(const MovingSurface& surface, std::size_t balls, const GapSamples& samples)
    : balls_(balls), present_(balls), tree_(present_) {
  const std::size_t triangles = surface.triangles().size();
  stride_ = triangles / kMostMiddles + 1;
  middles_ = (triangles + stride_ - 1) / stride_;
  points_.resize(middles_ + samples.points().size());
  held_by_.resize(points_.size());
  ball_of_.reserve(balls);
}

void WatchedPoints::start(const MovingSurface& surface, std::span<const Ball> balls, const GapSamples& samples,
                          WorkerPool& pool) {
  std::ranges::copy(balls, balls_.begin());
  present_.clear();
  ball_of_.clear();
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (!(balls[i].radius > 0)) continue;
    present_.push_back(balls[i]);
    ball_of_.push_back(i);
  }
  tree_.rebuild(present_);
  pool.run(points_.size(), 64, [&](std::size_t i) {
    const bool is_middle = i < middles_, is_any = !present_.empty();
    const SurfacePoint on =
        is_middle ? middle_of(static_cast<std::uint32_t>(i * stride_)) : samples.points()[i - middles_];
    const Point at = surface.at(on);
    const NearestBall nearest = tree_.nearest(at);
    points_[i] = {at, is_any ? nearest.distance : surface.longest_side(), on.triangle, is_middle};
    held_by_[i] = is_any ? ball_of_[nearest.ball] : kHeldByNone;
  });
  greatest_ = 0;
  for (const WatchedPoint& point : points_) greatest_ = std::max(greatest_, point.distance);
}

std::uint32_t WatchedPoints::nearest_but(std::uint32_t ball, const Point& at, double& distance) const {
  distance = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = kHeldByNone;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    if (i == ball || !(balls_[i].radius > 0)) continue;
    const double now = length(at - balls_[i].centre) - balls_[i].radius;
    if (now < distance) {
      distance = now;
      nearest = i;
    }
  }
  return nearest;
}

bool WatchedPoints::can_leave(std::uint32_t ball) const {
  double distance = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (held_by_[i] != ball) continue;
    nearest_but(ball, points_[i].at, distance);
    if (distance > greatest_) return false;
  }
  return true;
}

void WatchedPoints::exchange(std::uint32_t ball, const Ball& by) {
  balls_[ball] = by;
  double distance = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (held_by_[i] == ball) held_by_[i] = nearest_but(kHeldByNone, points_[i].at, distance);
  }
}

}  // namespace medial_vk
