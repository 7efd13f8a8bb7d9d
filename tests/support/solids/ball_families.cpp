#include "support/solids/ball_families.h"

#include <cmath>
#include <numbers>
#include <random>

namespace medial_vk::test {
namespace {

/// The same numbers with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Point in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Point direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  std::size_t below(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

std::vector<Ball> random_balls(std::size_t count, unsigned seed, double least, double most) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    c = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    r = random.between(least, most);
  }
  return balls;
}

std::vector<Ball> lattice(int n, double radius, double noise, unsigned seed) {
  Random random(seed);
  std::vector<Ball> balls;
  for (int i = 0; i < n * n * n; ++i) {
    Ball ball = {{static_cast<double>(i % n), static_cast<double>(i / n % n), static_cast<double>(i / n / n)}, radius};
    for (double& x : ball.centre) x += random.between(-noise, noise);
    ball.radius += random.between(-noise, noise);
    balls.push_back(ball);
  }
  return balls;
}

std::vector<Ball> flat_lattice(int n, double radius) {
  std::vector<Ball> balls;
  for (int i = 0; i < n * n; ++i) {
    balls.push_back({{static_cast<double>(i % n), static_cast<double>(i / n), 0.5}, radius});
  }
  return balls;
}

std::vector<Ball> through_a_point(std::size_t count, unsigned seed, bool all_directions) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    const Point direction = random.direction();
    r = random.between(0.5, 1);
    for (std::size_t k = 0; k < 3; ++k) c[k] = r * direction[k];
    if (!all_directions) c[2] = std::fabs(c[2]);
  }
  return balls;
}

std::vector<Ball> collinear(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    const double t = random.between(-1, 1);
    c = {0.3 * t, -0.7 * t + 0.1, 0.9 * t};
    r = random.between(0.05, 0.3);
  }
  return balls;
}

std::vector<Ball> of_all_sizes(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    r = std::pow(10, random.between(-12, 0));
    // Distances scale with radii, so that balls of all sizes overlap.
    c = random.in_cube(2 * std::pow(r, 0.9));
  }
  return balls;
}

std::vector<Ball> concentric(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    c = {0.1, 0.2, 0.3};
    r = static_cast<double>(1 + random.below(count)) / static_cast<double>(count);
  }
  return balls;
}

std::vector<Ball> on_a_plane(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<Ball> balls(count);
  for (auto& [c, r] : balls) {
    r = random.between(0.02, 0.2);
    c = {random.between(0, 1), random.between(0, 1), r};
  }
  return balls;
}

std::vector<Ball> cospherical(std::size_t count, double radius) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    balls.push_back({{r * std::cos(angle), r * std::sin(angle), z}, radius});
  }
  return balls;
}

}  // namespace medial_vk::test
