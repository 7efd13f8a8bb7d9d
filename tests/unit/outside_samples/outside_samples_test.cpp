// The volume of balls outside a solid, by samples, where it is known in closed form.
#include "outside_samples/outside_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kCount = 20'000;
constexpr double kProtrusion = 0.1;

/// In the half-space of the points with a height of at most 0.95, and in the ball of radius 0.97 around the origin.
double depth_in_half_space(const Point& p) { return 0.95 - p[2]; }
double depth_in_ball(const Point& p) { return 0.97 - length(p); }

/// Of the unit ball, above the half-space: a cap of height h.
double cap_volume() {
  constexpr double kHeight = 0.05;
  return std::numbers::pi * kHeight * kHeight * (3 - kHeight) / 3;
}

OutsideEstimate estimate(const std::vector<Ball>& balls, double (*depth)(const Point&)) {
  const OutsideSamples samples(balls, kProtrusion, kCount);
  EXPECT_EQ(samples.points().size(), kCount);
  std::vector<double> depths;
  for (const Point& p : samples.points()) depths.push_back(depth(p));
  return samples.estimate(depths);
}

/// Deviations of more than four standard errors have a probability below 1e-4; the samples are the same in each run.
void expect_volume(const OutsideEstimate& found, double volume) {
  EXPECT_GT(found.standard_error, 0);
  EXPECT_LT(found.standard_error, 0.1 * volume);
  EXPECT_NEAR(found.volume, volume, 4 * found.standard_error);
}

TEST(OutsideSamples, FindTheVolumeOfACap) {
  expect_volume(estimate({{{0, 0, 0}, 1}}, depth_in_half_space), cap_volume());
}

TEST(OutsideSamples, FindTheVolumeOfALayer) {
  const double layer = 4 * std::numbers::pi / 3 * (1 - 0.97 * 0.97 * 0.97);
  expect_volume(estimate({{{0, 0, 0}, 1}}, depth_in_ball), layer);
}

// A small ball is inside; of the others each has a cap of its own.
TEST(OutsideSamples, SumOverBalls) {
  expect_volume(estimate({{{0, 0, 0}, 1}, {{0, 0, -2}, 0.5}, {{5, 0, 0}, 1}}, depth_in_half_space), 2 * cap_volume());
}

TEST(OutsideSamples, WhatSeveralBallsHoldCountsOnce) {
  expect_volume(estimate({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 0, 0}, 1}}, depth_in_half_space), cap_volume());
}

TEST(OutsideSamples, WhatAnotherBallHoldsWithLessThanItsRadiusIsInside) {
  const OutsideEstimate found = estimate({{{0, 0, 0}, 1}, {{0, 0, 0}, 1.2}}, [](const Point& p) {
    return length(p) < 1 ? -1.0 : 1.0;  // as if the first ball alone were outside
  });
  EXPECT_EQ(found.volume, 0);
}

TEST(OutsideSamples, WithoutASampleOutsideTheErrorIsThatOfThree) {
  const OutsideEstimate none = estimate({{{0, 0, 0}, 1}}, [](const Point&) { return 1.0; });
  EXPECT_EQ(none.volume, 0);
  const double layer = 4 * std::numbers::pi / 3 * (1 - 0.9 * 0.9 * 0.9);
  EXPECT_DOUBLE_EQ(none.standard_error, 3 * layer / kCount);
}

TEST(OutsideSamples, AreInTheLayersOfTheirBalls) {
  const std::vector<Ball> balls = {{{1, 2, 3}, 0.5}, {{-4, 0, 0}, 0.05}, {{0, 0, 0}, 0}};
  const OutsideSamples samples(balls, kProtrusion, kCount);
  for (const Point& p : samples.points()) {
    const double of_first = length(p - balls[0].centre), of_second = length(p - balls[1].centre);
    // Coordinates and lengths below 8 are rounded by less than 2^-50.
    const bool is_in_first = of_first > 0.4 - 0x1p-48 && of_first < 0.5 + 0x1p-48;
    ASSERT_TRUE(is_in_first || of_second < 0.05 + 0x1p-48);
  }
}

TEST(OutsideSamples, ThereAreNoneWithoutABall) {
  const OutsideSamples none(std::vector<Ball>{{{0, 0, 0}, 0}}, kProtrusion, kCount);
  EXPECT_TRUE(none.points().empty());
  EXPECT_EQ(none.estimate({}).volume, 0);
  EXPECT_EQ(none.estimate({}).standard_error, 0);
}

}  // namespace
}  // namespace medial_vk
