// Volumes of unions of hulls between bounds: against closed forms, unions of balls and samples; cells; wrong usage.
#include "medial_vk/hull_union.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stop_token>
#include <vector>

#include "base/point_ops.h"
#include "hull_unions/cut_cube.h"
#include "medial_vk/ball_union.h"
#include "support/hulls/random_hulls.h"
#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

Bounds measured(const std::vector<BallHull>& hulls, double width, unsigned threads = 2) {
  const Result<Bounds> bounds = measure_hull_union(hulls, {width, threads});
  EXPECT_TRUE(bounds.ok()) << bounds.error().message;
  if (!bounds.ok()) return {};
  EXPECT_LE(bounds.value().upper - bounds.value().lower, width);
  return bounds.value();
}

/// `volume` is exact up to `error`.
void expect_between(const Bounds& bounds, double volume, double error) {
  EXPECT_LE(bounds.lower, volume + error);
  EXPECT_GE(bounds.upper, volume - error);
}

TEST(HullUnion, OfOneHullIsItsVolume) {
  std::mt19937_64 random(21);
  for (std::uint32_t i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const BallHull hull = test::random_hull(1 + i % 3, random);
    const double volume = volume_of(hull);
    for (const double share : {0.1, 0.01, 0.003}) {
      const double width = std::max(share * volume, 1e-5);
      expect_between(measured({hull}, width), volume, 1e-12 * volume);
    }
  }
}

TEST(HullUnion, OfBallsIsThatOfUnionsOfBalls) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<Ball> balls = test::random_balls(40, seed, 0.05, 0.4);
    std::vector<BallHull> hulls;
    for (const Ball& ball : balls) hulls.push_back(hull_of(ball));
    const double volume = measure_ball_union(balls).value().volume;
    for (const double share : {0.05, 0.002}) expect_between(measured(hulls, share * volume), volume, 1e-11 * volume);
  }
}

TEST(HullUnion, OfApartHullsIsTheirSumAndOfNestedOnesTheGreatest) {
  const BallHull slab = hull_of({{0, 0, 0}, 0.2}, {{1, 0, 0}, 0.1}, {{0, 1, 0}, 0.15});
  const BallHull capsule = hull_of({{2, 0, 0}, 0.2}, {{2, 1, 1}, 0.2}), ball = hull_of({{0, 0, 3}, 0.5});
  const double sum = volume_of(slab) + volume_of(capsule) + volume_of(ball);
  expect_between(measured({slab, capsule, ball}, 0.002 * sum), sum, 1e-12);
  const BallHull around = hull_of({{0, 0, 0}, 2}, {{1, 1, 0}, 2});
  const double whole = volume_of(around);
  expect_between(measured({slab, around, slab, around}, 0.002 * whole), whole, 1e-11);
}

// Parts of one slab: what they share has no volume.
TEST(HullUnion, OfPartsOfAHullIsTheHull) {
  const Ball a = {{0, 0, 0}, 0.2}, b = {{2, 0, 0}, 0.1}, c = {{0, 1, 0.5}, 0.05};
  const Ball middle = {{1, 0, 0}, 0.15};
  const double volume = volume_of(hull_of(a, b, c));
  const Bounds bounds = measured({hull_of(a, middle, c), hull_of(middle, b, c)}, 0.002 * volume);
  expect_between(bounds, volume, 1e-12);
}

TEST(HullUnion, BoundsHoldSamplesAndShrinkWithTheWidth) {
  for (const unsigned seed : {31u, 32u, 33u, 34u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<BallHull> hulls;
    for (std::uint32_t i = 0; i < 12; ++i) {
      hulls.push_back(test::random_hull(1 + i % 3, random));
      for (Ball& ball : hulls.back().corners) ball.radius *= 0.5;
    }
    const Bounds coarse = measured(hulls, 0.2), fine = measured(hulls, 0.01);
    EXPECT_LE(coarse.lower, fine.upper);
    EXPECT_GE(coarse.upper, fine.lower);
    // Balls of random hulls reach at most to 1 + (length of a diagonal) / 2, halved: within 3.
    constexpr int kSamples = 100'000;
    std::uniform_real_distribution<double> coordinate(-3, 3);
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      Point p{};
      for (double& x : p) x = coordinate(random);
      inside += std::any_of(hulls.begin(), hulls.end(), [&](const BallHull& h) { return signed_distance(h, p) <= 0; });
    }
    const double share = static_cast<double>(inside) / kSamples;
    const double error = 5 * 216 * std::sqrt(share * (1 - share) / kSamples);
    expect_between(fine, 216 * share, error);
  }
}

TEST(HullUnion, DoesNotDependOnThreads) {
  std::mt19937_64 random(41);
  std::vector<BallHull> hulls;
  for (std::uint32_t i = 0; i < 20; ++i) hulls.push_back(test::random_hull(1 + i % 3, random));
  const Bounds one = measured(hulls, 0.05, 1);
  for (const unsigned threads : {2u, 5u}) {
    const Bounds many = measured(hulls, 0.05, threads);
    EXPECT_EQ(one.lower, many.lower);
    EXPECT_EQ(one.upper, many.upper);
  }
}

TEST(HullUnion, WithoutVolumeIsNothing) {
  for (const auto& hulls :
       {std::vector<BallHull>{}, {hull_of({{1, 2, 3}, 0}), hull_of({{0, 0, 0}, 0}, {{1, 0, 0}, 0})}}) {
    const Bounds bounds = measured(hulls, 1e-9);
    EXPECT_EQ(bounds.lower, 0);
    EXPECT_EQ(bounds.upper, 0);
  }
}

// Far from the origin rounding is greater, and the bounds still hold.
TEST(HullUnion, HoldsFarFromTheOrigin) {
  BallHull slab = hull_of({{0, 0, 0}, 0.25}, {{1, 0, 0}, 0.125}, {{0, 1, 0}, 0.1875});
  const double volume = volume_of(slab);
  for (Ball& ball : slab.corners) ball.centre = ball.centre + Point{1e6, -1e6, 1e6};
  expect_between(measured({slab}, 0.005 * volume), volume, 1e-12);
}

// Where coordinates have too few digits the bounds are farther apart than asked, and still hold.
TEST(HullUnion, BoundsAreAsCloseAsRoundingAllows) {
  const BallHull ball = hull_of({{1e15, 0, 0}, 1});
  const Result<Bounds> bounds = measure_hull_union({&ball, 1}, {0.001, 1});
  ASSERT_TRUE(bounds.ok()) << bounds.error().message;
  expect_between(bounds.value(), volume_of(ball), 0);
  EXPECT_GT(bounds.value().upper - bounds.value().lower, 0.001);
}

TEST(HullUnion, FarAwayTheBoundsAreAsCloseAsRoundingAllows) {
  const double volume = 4 * std::numbers::pi / 3;
  double last = 0;
  for (const double far : {1e6, 1e8, 1e9}) {
    const Result<Bounds> bounds = measure_hull_union(std::vector<BallHull>{hull_of({{far, 0, 0}, 1})}, {1e-3, 1});
    ASSERT_TRUE(bounds.ok()) << bounds.error().message;
    EXPECT_LE(bounds.value().lower, volume);
    EXPECT_GE(bounds.value().upper, volume);
    const double width = bounds.value().upper - bounds.value().lower;
    // Cells along the surface are kept where their gap is below 64 times the rounding of distances, 2^-46 of the
    // greatest coordinate and the side, times the area through them; as much again may be left of the others.
    EXPECT_LT(width, 1e-3 + 2 * 4 * std::numbers::pi * 64 * 0x1p-46 * (far + 3)) << far;
    EXPECT_GE(width, last / 2) << far;
    last = width;
  }
}

TEST(HullUnion, NamesWhatItRefuses) {
  const BallHull ball = hull_of({{0, 0, 0}, 1});
  const auto message_of = [](const std::vector<BallHull>& hulls, double width) {
    const Result<Bounds> bounds = measure_hull_union(hulls, {width, 1});
    if (bounds.ok()) return std::string();
    EXPECT_EQ(bounds.error().code, ErrorCode::kUsage);
    return bounds.error().message;
  };
  for (const double width : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(message_of({ball}, width).find("width"), std::string::npos);
  }
  EXPECT_NE(message_of({ball, hull_of({{1e19, 0, 0}, 1})}, 0.1).find("hull 1 is not finite or beyond"),
            std::string::npos);
  EXPECT_NE(message_of({ball, hull_of({{0, 0, 0}, -1})}, 0.1).find("hull 1 has a negative radius"), std::string::npos);
  EXPECT_NE(message_of({ball, ball, hull_of({{0, std::nan(""), 0}, 1})}, 0.1).find("hull 2"), std::string::npos);
  BallHull four = ball;
  four.count = 4;
  EXPECT_NE(message_of({four}, 0.1).find("hull 0 has 4 balls"), std::string::npos);
  EXPECT_NE(message_of(std::vector<BallHull>((1u << 20) + 1, ball), 0.1).find("2^20"), std::string::npos);
}

TEST(HullUnion, CanBeStopped) {
  std::stop_source source;
  source.request_stop();
  const BallHull ball = hull_of({{0, 0, 0}, 1});
  const Result<Bounds> bounds = measure_hull_union({&ball, 1}, {0.01, 1}, source.get_token());
  ASSERT_FALSE(bounds.ok());
  EXPECT_EQ(bounds.error().code, ErrorCode::kInterrupted);
}

TEST(CutCube, HasKnownVolumes) {
  CutCube whole;
  EXPECT_EQ(whole.volume(), 8);
  EXPECT_TRUE(whole.cut({1, 0, 0}, 0.5));
  EXPECT_DOUBLE_EQ(whole.volume(), 2);
  EXPECT_TRUE(whole.cut({0, 0.6, 0.8}, 0));
  EXPECT_DOUBLE_EQ(whole.volume(), 1);
  EXPECT_TRUE(whole.cut({-1, 0, 0}, 0));
  EXPECT_TRUE(whole.empty());
  EXPECT_EQ(whole.volume(), 0);
  // A corner: x + y + z >= 2 holds in a tetrahedron of side 1.
  CutCube corner;
  const double third = 1 / std::sqrt(3.0);
  EXPECT_TRUE(corner.cut({third, third, third}, 2 * third));
  EXPECT_NEAR(corner.volume(), 1.0 / 6, 1e-15);
  CutCube outside;
  EXPECT_TRUE(outside.cut({third, third, third}, -1.8));
  EXPECT_EQ(outside.volume(), 8);
}

// Both parts that a plane leaves add up to what was there, after some cuts and for planes through corners and edges.
TEST(CutCube, PartsAddUp) {
  std::mt19937_64 random(51);
  std::normal_distribution<double> normal;
  int consistent = 0;
  constexpr int kRuns = 20'000;
  for (int i = 0; i < kRuns; ++i) {
    CutCube cube;
    bool good = true;
    for (std::size_t k = 0; k + 1 < CutCube::kMostCuts && good; ++k) {
      Point n{};
      for (double& x : n) x = i % 3 == 0 ? std::round(normal(random)) : normal(random);
      if (length(n) == 0) continue;
      n = (1 / length(n)) * n;
      // Planes through corners, through the middle, and any.
      const double offset = i % 2 == 0 ? 0.3 * normal(random) - 0.5 : -dot(n, {1, 1, i % 4 == 1 ? 0.0 : 1.0});
      CutCube other = cube;
      const double before = cube.volume();
      good = other.cut(-1.0 * n, -offset) && cube.cut(n, offset);
      if (good) {
        EXPECT_NEAR(cube.volume() + other.volume(), before, CutCube::kRounding) << i;
      }
    }
    consistent += good ? 1 : 0;
  }
  EXPECT_GT(consistent, kRuns * 99 / 100);
}

}  // namespace
}  // namespace medial_vk
