#include "cover_following/cavities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"

namespace medial_vk {
namespace {

/// The least radius with which a ball around the point holds the cavity.
double radius_to_hold(const Point& centre, std::span<const Ball> cavity) {
  double radius = 0;
  for (const Ball& point : cavity) {
    radius = std::max(radius, length(point.centre - centre) * (1 + 0x1p-50) + point.radius);
  }
  return radius;
}

}  // namespace

/// The vertices of the envelope that may lie on a cavity in the solid.
void CavitySearch::find_points(const MovingSurface& surface, WorkerPool& pool) {
  constexpr std::size_t kAtOnce = 16;
  const std::vector<EnvelopeVertex>& vertices = envelope_.vertices();
  errors_.resize(vertices.size());
  pool.run(vertices.size(), kAtOnce, [&](std::size_t i) {
    const double error = envelope_.error_of(vertices[i]) + 2 * surface.rounding();
    errors_[i] = std::isfinite(error) && surface.is_known_outside(vertices[i].at, error) ? -1 : error;
  });
  // A ball that holds a vertex by more than the tolerance takes it out of the envelope.
  const double room = 4 * envelope_.tolerance();
  inside_.clear();
  points_.clear();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (errors_[i] < 0) continue;
    inside_.push_back(vertices[i]);
    points_.push_back({vertices[i].at, errors_[i] + room});
  }
}

/// Groups in the order of their least points, and points of a group in their order.
void CavitySearch::group_points(Joined joined) {
  const auto count = static_cast<std::uint32_t>(inside_.size());
  groups_.reset(count);
  keys_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = inside_[i].balls;
    const std::array<std::array<std::uint32_t, 2>, 3> arcs = {{{a, b}, {b, c}, {a, c}}},
                                                      balls = {{{a, a}, {b, b}, {c, c}}};
    const std::array<std::array<std::uint32_t, 2>, 3> all = {};
    for (const auto& key : joined == Joined::kByArcs ? arcs : joined == Joined::kByBalls ? balls : all) {
      keys_.push_back({key, i});
    }
  }
  std::ranges::sort(keys_, {}, [](const Key& key) { return std::pair(key.balls, key.vertex); });
  for (std::size_t k = 1; k < keys_.size(); ++k) {
    if (keys_[k - 1].balls != keys_[k].balls) continue;
    groups_.join(keys_[k - 1].vertex, keys_[k].vertex);
  }
  grouped_.clear();
  for (std::uint32_t i = 0; i < count; ++i) grouped_.push_back({groups_.of(i), i});
  std::ranges::sort(grouped_, {}, [](const Grouped& grouped) { return std::pair(grouped.group, grouped.vertex); });
  by_group_.clear();
  for (const Grouped& grouped : grouped_) by_group_.push_back(points_[grouped.vertex]);
}

/// The ball whose cube of the radius grows least holds the cavity. One of radius 0 is placed in its middle, and has no
/// less than `least_radius`. False: the points of the cavity are not known.
bool CavitySearch::fill_one(Cavity cavity, double least_radius, std::vector<Ball>& balls) {
  const auto cube = [](double x) { return x * x * x; };
  centres_.clear();
  for (const Ball& point : cavity) centres_.push_back(point.centre);
  const Point middle = smallest_ball(centres_).centre;
  std::size_t best = balls.size();
  Ball filled;
  double least_cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Point& centre = balls[i].radius > 0 ? balls[i].centre : middle;
    const double room = balls[i].radius > 0 ? balls[i].radius : least_radius;
    const double radius = std::max(room, radius_to_hold(centre, cavity));
    const double cost = cube(radius) - cube(balls[i].radius);
    if (!(cost < least_cost)) continue;
    least_cost = cost;
    best = i;
    filled = {centre, radius};
  }
  if (best == balls.size()) return false;
  balls[best] = filled;
  return true;
}

Result<bool> CavitySearch::fill(const MovingSurface& surface, std::vector<Ball>& balls, WorkerPool& pool) {
  constexpr double kLeastShare = 1e-3;     // of the longest side; points that tiny spheres share have great errors
  constexpr int kByArcs = 4, kRounds = 8;  // in the last one, one ball holds all that is left
  for (int round = 0; round < kRounds; ++round) {
    holding_.clear();
    std::ranges::copy_if(balls, std::back_inserter(holding_), [](const Ball& ball) { return ball.radius > 0; });
    if (Status status = envelope_.rebuild(holding_, measurer_, pool); !status) return status.error();
    find_points(surface, pool);
    if (points_.empty()) return true;
    group_points(round + 1 == kRounds ? Joined::kAll : round < kByArcs ? Joined::kByArcs : Joined::kByBalls);
    for (std::size_t begin = 0, end = 0; begin < grouped_.size(); begin = end) {
      while (end < grouped_.size() && grouped_[end].group == grouped_[begin].group) ++end;
      const Cavity cavity = std::span(by_group_).subspan(begin, end - begin);
      if (!fill_one(cavity, kLeastShare * surface.longest_side(), balls)) return false;
    }
  }
  return true;
}

}  // namespace medial_vk
