// Hulls of balls at random, of each kind, and a record that holds them.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "output/hull_files/hull_record.h"

namespace medial_vk::test {

/// Hulls of each kind in turn around `middle`, of about this size: balls, capsules, cones, slabs, a cone of which one
/// ball nearly holds the other, and a cone of which it does.
inline std::vector<BallHull> sample_hulls(std::size_t count, const Point& middle, double size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto ball = [&]() {
    Ball made;
    for (std::size_t k = 0; k < 3; ++k) made.centre[k] = middle[k] + size * uniform(random);
    made.radius = size * (0.02 + 0.2 * (1 + uniform(random)));
    return made;
  };
  std::vector<BallHull> hulls;
  for (std::size_t i = 0; i < count; ++i) {
    const Ball a = ball();
    Ball b = ball();
    const Ball c = ball();
    if (i % 6 == 0) hulls.push_back(hull_of(a));
    if (i % 6 == 1) hulls.push_back(hull_of(a, {b.centre, a.radius}));
    if (i % 6 == 2) hulls.push_back(hull_of(a, b));
    if (i % 6 == 3) hulls.push_back(hull_of(a, b, c));
    if (i % 6 < 4) continue;
    // With the centres at 0.9 of the difference of the radii the larger ball holds the other, at 1.1 it does not.
    const double share = (i % 6 == 4 ? 1.1 : 0.9) * 0.6 * a.radius;
    b.centre = {a.centre[0], a.centre[1] - 0.6 * share, a.centre[2] + 0.8 * share};
    b.radius = 0.4 * a.radius;
    hulls.push_back(hull_of(a, b));
  }
  return hulls;
}

inline HullRecord record_of(std::vector<BallHull> hulls, const std::string& name = "part") {
  HullRecord record;
  record.name = name;
  record.fit.proof.tested = hulls.size();
  record.fit.proof.planes = 1234;
  record.fit.hulls = std::move(hulls);
  record.fit.covered = {3.5, 3.625};
  record.fit.solid_volume = 4;
  record.fit.gap = {0.1, 0.30000000000000004};
  record.fit.greatest_shrink = 1e-7;
  return record;
}

}  // namespace medial_vk::test
