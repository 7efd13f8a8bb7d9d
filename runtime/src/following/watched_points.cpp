#include "following/watched_points.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/nearest_ball_tree.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostMiddles = 20000;
constexpr std::uint32_t kHeldByNone = 0xffffffffu;

}  // namespace

WatchedPoints::WatchedPoints(const MovingSurface& surface, std::span<const Ball> balls, const GapSamples& samples,
                             unsigned threads)
    : balls_(balls.begin(), balls.end()) {
  std::vector<Ball> present;
  std::vector<std::uint32_t> ball_of;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (!(balls[i].radius > 0)) continue;
    present.push_back(balls[i]);
    ball_of.push_back(i);
  }
  std::optional<NearestBallTree> tree;
  if (!present.empty()) tree.emplace(present);
  const std::size_t triangles = surface.triangles().size(), stride = triangles / kMostMiddles + 1;
  const std::size_t middles = (triangles + stride - 1) / stride;
  points_.resize(middles + samples.points().size());
  held_by_.resize(points_.size());
  parallel_for(points_.size(), 64, threads, [&](std::size_t i) {
    const bool is_middle = i < middles;
    const SurfacePoint on =
        is_middle ? middle_of(static_cast<std::uint32_t>(i * stride)) : samples.points()[i - middles];
    const Point at = surface.at(on);
    const NearestBall nearest = tree ? tree->nearest(at) : NearestBall();
    points_[i] = {at, tree ? nearest.distance : surface.longest_side(), on.triangle, is_middle};
    held_by_[i] = tree ? ball_of[nearest.ball] : kHeldByNone;
  });
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
