#include "sphere_fits/quality/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "sphere_fits/quality/branch_and_bound.h"

namespace medial_vk {
namespace {

/// Greatest number of samples on one sphere: more are useless, even if its part of the envelope is small.
constexpr std::size_t kMostPerSphere = 4096;

double fraction(double x) { return x - std::floor(x); }

}  // namespace

std::vector<Point> sample_surface(const Mesh& mesh, std::size_t count) {
  std::vector<double> until(mesh.triangles.size());
  CompensatedSum sum;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    sum.add(0.5 * length(cross(mesh.vertices[c[1]] - mesh.vertices[c[0]], mesh.vertices[c[2]] - mesh.vertices[c[0]])));
    until[t] = sum.value();
  }
  std::vector<Point> points;
  points.reserve(count);
  std::size_t t = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double position = (static_cast<double>(k) + 0.5) / static_cast<double>(count) * sum.value();
    while (t + 1 < until.size() && until[t] < position) ++t;
    const double i = static_cast<double>(k) + 1;
    double u = fraction(0.5 + 0.7548776662466927 * i), v = fraction(0.5 + 0.5698402909980532 * i);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Triangle& c = mesh.triangles[t];
    const Point &a = mesh.vertices[c[0]], &b = mesh.vertices[c[1]], &d = mesh.vertices[c[2]];
    points.push_back(a + (u * (b - a) + v * (d - a)));
  }
  return points;
}

Point spiral_point(std::size_t k, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count);
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(k);
  const double across = std::sqrt(std::max(0.0, 1 - z * z));
  return {across * std::cos(turn), across * std::sin(turn), z};
}

std::vector<WeightedPoint> sample_envelope(const Envelope& envelope, std::size_t count, const Threads& threads) {
  const std::vector<Ball>& balls = envelope.tree().balls();
  const BallUnion& measured = envelope.measured();
  std::vector<std::vector<WeightedPoint>> parts(balls.size());
  for_all(balls.size(), 4, threads, [&](std::size_t i) {
    if (!(measured.areas[i] > 0) || !(measured.area > 0)) return;
    const Ball& ball = balls[i];
    const double whole = 4 * std::numbers::pi * ball.radius * ball.radius;
    const double wanted = std::ceil(static_cast<double>(count) * whole / measured.area);
    const auto all = static_cast<std::size_t>(std::clamp(wanted, 16.0, static_cast<double>(kMostPerSphere)));
    for (std::size_t k = 0; k < all; ++k) {
      const Point at = ball.centre + ball.radius * spiral_point(k, all);
      if (!envelope.tree().holds(at, envelope.tolerance())) parts[i].push_back({at, 0});
    }
    for (WeightedPoint& point : parts[i]) point.area = measured.areas[i] / static_cast<double>(parts[i].size());
  });
  std::vector<WeightedPoint> points;
  for (const auto& part : parts) points.insert(points.end(), part.begin(), part.end());
  return points;
}

}  // namespace medial_vk
