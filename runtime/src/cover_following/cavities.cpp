#include "cover_following/cavities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/envelope.h"

namespace medial_vk {
namespace {

/// Points that a ball must hold, with bounds of their errors, as balls.
using Cavity = std::vector<Ball>;

/// How vertices are divided into cavities: those that arcs may join, those that share a ball, or none.
enum class Joined : std::uint8_t { kByArcs, kByBalls, kAll };

/// The sets of indices of vertices, each in ascending order.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<EnvelopeVertex>& vertices, Joined joined) {
  std::vector<std::size_t> root(vertices.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::array<std::uint32_t, 2>, std::size_t> first;  // vertex with these balls
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto& [a, b, c] = vertices[i].balls;
    const std::array<std::array<std::uint32_t, 2>, 3> arcs = {{{a, b}, {b, c}, {a, c}}},
                                                      balls = {{{a, a}, {b, b}, {c, c}}};
    const std::array<std::array<std::uint32_t, 2>, 3> all = {};
    for (const auto& key : joined == Joined::kByArcs ? arcs : joined == Joined::kByBalls ? balls : all) {
      const std::size_t other = root_of(first.try_emplace(key, i).first->second), own = root_of(i);
      root[std::max(own, other)] = std::min(own, other);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> by_root;
  for (std::size_t i = 0; i < vertices.size(); ++i) by_root[root_of(i)].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(by_root.size());
  for (auto& [least, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

/// The vertices of the envelope that may lie on a cavity in the solid.
std::vector<Cavity> cavities_of(const MovingSurface& surface, const Envelope& envelope, Joined joined,
                                unsigned threads) {
  constexpr std::size_t kAtOnce = 16;
  const std::vector<EnvelopeVertex>& vertices = envelope.vertices();
  std::vector<double> errors(vertices.size());  // negative: not in the solid
  parallel_for(vertices.size(), kAtOnce, threads, [&](std::size_t i) {
    const double error = envelope.error_of(vertices[i]) + 2 * surface.rounding();
    errors[i] = std::isfinite(error) && surface.is_known_outside(vertices[i].at, error) ? -1 : error;
  });
  // A ball that holds a vertex by more than the tolerance takes it out of the envelope.
  const double room = 4 * envelope.tolerance();
  std::vector<EnvelopeVertex> inside;
  Cavity points;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (errors[i] < 0) continue;
    inside.push_back(vertices[i]);
    points.push_back({vertices[i].at, errors[i] + room});
  }
  std::vector<Cavity> cavities;
  for (const std::vector<std::size_t>& group : groups_of(inside, joined)) {
    Cavity cavity;
    for (const std::size_t i : group) cavity.push_back(points[i]);
    cavities.push_back(std::move(cavity));
  }
  return cavities;
}

/// The least radius with which a ball around the point holds the cavity.
double radius_to_hold(const Point& centre, const Cavity& cavity) {
  double radius = 0;
  for (const Ball& point : cavity) {
    radius = std::max(radius, length(point.centre - centre) * (1 + 0x1p-50) + point.radius);
  }
  return radius;
}

/// The ball whose cube of the radius grows least holds the cavity. One of radius 0 is placed in its middle, and has no
/// less than `least_radius`. False: the points of the cavity are not known.
bool fill(const Cavity& cavity, double least_radius, std::vector<Ball>& balls) {
  const auto cube = [](double x) { return x * x * x; };
  std::vector<Point> points;
  for (const Ball& point : cavity) points.push_back(point.centre);
  const Point middle = smallest_ball(points).centre;
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

}  // namespace

Result<bool> fill_cavities(const MovingSurface& surface, std::vector<Ball>& balls, unsigned threads) {
  constexpr double kLeastShare = 1e-3;     // of the longest side; points that tiny spheres share have great errors
  constexpr int kByArcs = 4, kRounds = 8;  // in the last one, one ball holds all that is left
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Ball> holding;
    std::ranges::copy_if(balls, std::back_inserter(holding), [](const Ball& ball) { return ball.radius > 0; });
    const Result<Envelope> envelope = Envelope::build(holding, threads);
    if (!envelope) return envelope.error();
    const Joined joined = round + 1 == kRounds ? Joined::kAll : round < kByArcs ? Joined::kByArcs : Joined::kByBalls;
    const std::vector<Cavity> cavities = cavities_of(surface, envelope.value(), joined, threads);
    for (const Cavity& cavity : cavities) {
      if (!fill(cavity, kLeastShare * surface.longest_side(), balls)) return false;
    }
    if (cavities.empty()) return true;
  }
  return true;
}

}  // namespace medial_vk
