#include "cover_following/cavities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/envelope.h"
#include "sphere_fits/quality/sphere_certificate.h"

namespace medial_vk {
namespace {

/// Points that a ball must hold, with bounds of their errors, as balls.
using Cavity = std::vector<Ball>;

/// The vertices of the envelope that may lie on a cavity in the solid; each component of those that share balls by
/// itself.
std::vector<Cavity> cavities_of(const MovingSurface& surface, const Envelope& envelope, unsigned threads) {
  constexpr std::size_t kAtOnce = 16;
  const std::vector<EnvelopeVertex>& vertices = envelope.vertices();
  std::vector<double> errors(vertices.size());  // negative: not in the solid
  parallel_for(vertices.size(), kAtOnce, threads, [&](std::size_t i) {
    const double error = vertex_error(envelope, vertices[i]) + 2 * surface.rounding();
    errors[i] = std::isfinite(error) && surface.is_known_outside(vertices[i].at, error) ? -1 : error;
  });
  std::vector<std::uint32_t> root(envelope.tree().balls().size());
  std::iota(root.begin(), root.end(), 0u);
  const auto root_of = [&](std::uint32_t ball) {
    while (root[ball] != ball) ball = root[ball] = root[root[ball]];
    return ball;
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (errors[i] < 0) continue;
    for (const std::uint32_t ball : vertices[i].balls) {
      const std::uint32_t a = root_of(ball), b = root_of(vertices[i].balls[0]);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  // A ball that holds a vertex by more than the tolerance takes it out of the envelope.
  const double room = 4 * envelope.tolerance();
  std::map<std::uint32_t, Cavity> by_root;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (errors[i] >= 0) by_root[root_of(vertices[i].balls[0])].push_back({vertices[i].at, errors[i] + room});
  }
  std::vector<Cavity> cavities;
  cavities.reserve(by_root.size());
  for (auto& [first, cavity] : by_root) cavities.push_back(std::move(cavity));
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

/// The ball whose cube of the radius grows least holds the cavity. False: its points are not known.
bool fill(const Cavity& cavity, std::vector<Ball>& balls) {
  const auto cube = [](double x) { return x * x * x; };
  std::vector<Point> points;
  for (const Ball& point : cavity) points.push_back(point.centre);
  const Point middle = smallest_ball(points).centre;
  std::size_t best = balls.size();
  Ball filled;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Point& centre = balls[i].radius > 0 ? balls[i].centre : middle;
    const double radius = std::max(balls[i].radius, radius_to_hold(centre, cavity));
    const double cost = cube(radius) - cube(balls[i].radius);
    if (!(cost < least)) continue;
    least = cost;
    best = i;
    filled = {centre, radius};
  }
  if (best == balls.size()) return false;
  balls[best] = filled;
  return true;
}

Cavity joined(const std::vector<Cavity>& cavities) {
  Cavity all;
  for (const Cavity& cavity : cavities) all.insert(all.end(), cavity.begin(), cavity.end());
  return all;
}

}  // namespace

Result<bool> fill_cavities(const MovingSurface& surface, std::vector<Ball>& balls, unsigned threads) {
  constexpr int kRounds = 8;  // the last one fills all that is left by one ball
  for (int round = 0;; ++round) {
    std::vector<Ball> holding;
    std::ranges::copy_if(balls, std::back_inserter(holding), [](const Ball& ball) { return ball.radius > 0; });
    const Result<Envelope> envelope = Envelope::build(holding, threads);
    if (!envelope) return envelope.error();
    const std::vector<Cavity> cavities = cavities_of(surface, envelope.value(), threads);
    if (cavities.empty()) return true;
    if (round + 1 == kRounds) return fill(joined(cavities), balls);
    for (const Cavity& cavity : cavities) {
      if (!fill(cavity, balls)) return false;
    }
  }
}

}  // namespace medial_vk
