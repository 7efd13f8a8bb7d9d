// Points of a lattice that balls hold, as an estimate of volumes.
#include "sphere_fits/steps/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

double volume_of_radius(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

std::vector<Ball> balls_in_box(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Ball> balls;
  for (int n = 0; n < count; ++n) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    balls.push_back({{x, y, z}, 0.05 + 0.2 * uniform(random)});
  }
  return balls;
}

/// The cubes around a ball's points cover the ball shrunk by half their diagonal, and lie in the ball grown by it.
TEST(Coverage, EstimatesTheVolumeOfABall) {
  Coverage coverage({0, 0, 0}, {2, 2.5, 3});
  coverage.divide(30000, {});
  EXPECT_NEAR(coverage.cell(), 1.0 / 30000, 1e-15);
  const double half_diagonal = 0.5 * std::sqrt(3.0) * std::cbrt(coverage.cell());
  for (Ball ball : balls_in_box(1, 50)) {
    for (double& x : ball.centre) x = 0.5 + x;
    const double estimate = coverage.uncovered(ball);
    EXPECT_GE(estimate, volume_of_radius(ball.radius - half_diagonal));
    EXPECT_LE(estimate, volume_of_radius(ball.radius + half_diagonal));
    coverage.add(ball);
    EXPECT_EQ(coverage.uncovered(ball), 0);
    coverage.remove(ball);
    EXPECT_EQ(coverage.uncovered(ball), estimate);
  }
}

/// Of two balls that overlap, each has as many points in both, whichever of them is there.
TEST(Coverage, CountsPointsOfSeveralBallsOnce) {
  const Ball large = {{0.5, 0.5, 0.5}, 0.4}, within = {{0.5, 0.6, 0.5}, 0.2}, other = {{0.8, 0.5, 0.5}, 0.3};
  Coverage coverage({0, 0, 0}, {1.2, 1, 1});
  coverage.divide(1e5, {});
  const double in_large = coverage.uncovered(large), in_other = coverage.uncovered(other);
  coverage.add(within);
  coverage.add(large);
  EXPECT_EQ(coverage.uncovered(within), 0);
  const double beside_large = coverage.uncovered(other);
  coverage.remove(within);
  EXPECT_EQ(coverage.uncovered(within), 0);
  EXPECT_EQ(coverage.uncovered(other), beside_large);
  coverage.add(other);
  coverage.remove(large);
  const double beside_other = coverage.uncovered(large);
  EXPECT_GT(in_large - beside_other, 0.01);
  EXPECT_NEAR(in_large - beside_other, in_other - beside_large, 1e-12);
}

/// What comes and goes leaves no trace; some of the balls reach out of the box, one is beside it.
TEST(Coverage, DependsOnTheBallsThatAreThereAlone) {
  const Point lower = {0.1, 0.2, 0}, upper = {0.9, 1, 0.7};
  std::vector<Ball> there = balls_in_box(2, 40), gone = balls_in_box(3, 40);
  there.push_back({{5, 5, 5}, 1});
  Coverage changed(lower, upper), fresh(lower, upper);
  changed.divide(1e5, gone);
  for (std::size_t i = 0; i < there.size(); ++i) {
    changed.add(there[i]);
    if (i < gone.size()) changed.remove(gone[i]);
  }
  fresh.divide(1e5, there);
  // One ball becomes another: far from it, near to it, or the same.
  Coverage replaced(lower, upper);
  replaced.divide(1e5, gone);
  for (std::size_t i = 0; i < gone.size(); ++i) {
    const Ball near = {there[i].centre + Point{0.01, -0.02, 0.005}, 1.1 * there[i].radius};
    replaced.replace(gone[i], near);
    replaced.replace(near, there[i]);
    replaced.replace(there[i], there[i]);
  }
  replaced.add(there.back());
  int differ_from_none = 0;
  for (const Ball& ball : balls_in_box(4, 200)) {
    EXPECT_EQ(changed.uncovered(ball), fresh.uncovered(ball));
    EXPECT_EQ(replaced.uncovered(ball), fresh.uncovered(ball));
    differ_from_none += fresh.uncovered(ball) > 0 ? 1 : 0;
  }
  EXPECT_GT(differ_from_none, 10);
}

TEST(Coverage, IsNoFinerThanTheBoxPermits) {
  Coverage cube({0, 0, 0}, {1, 1, 1});
  cube.divide(1e30, {});
  EXPECT_GE(cube.cell(), 0.7 / (1 << 25));
  EXPECT_NEAR(cube.uncovered({{0.5, 0.5, 0.5}, 0.3}), volume_of_radius(0.3), 1e-4);
  // Points of a flat box are few although its volume is small.
  Coverage flat({0, 0, 0}, {1, 1, 1e-9});
  flat.divide(1e30, {});
  EXPECT_GE(std::cbrt(flat.cell()), 1.0 / (1 << 13));
}

}  // namespace
}  // namespace medial_vk
