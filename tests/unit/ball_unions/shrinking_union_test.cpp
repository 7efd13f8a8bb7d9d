// A union that shrinks agrees at every step with a new measurement.
#include "medial_vk/shrinking_union.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

constexpr double kSame = 1e-12;  // relative

ShrinkingUnion build(const std::vector<Ball>& balls) {
  auto result = ShrinkingUnion::build(balls, {.threads = 2});
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(result).value();
}

void expect_same(const ShrinkingUnion& shrinking, const std::vector<Ball>& balls) {
  std::vector<Ball> left;
  std::vector<std::uint32_t> names;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (!shrinking.holds(i)) {
      EXPECT_EQ(shrinking.volumes()[i], 0);
      continue;
    }
    left.push_back(balls[i]);
    names.push_back(i);
  }
  const auto fresh = measure_ball_union(left, {.threads = 1, .complex = true});
  ASSERT_TRUE(fresh.ok());
  EXPECT_NEAR(shrinking.volume(), fresh.value().volume, kSame * fresh.value().volume);
  for (std::size_t n = 0; n < names.size(); ++n) {
    EXPECT_NEAR(shrinking.volumes()[names[n]], fresh.value().volumes[n], kSame * fresh.value().volume);
  }
  EXPECT_EQ(shrinking.betti().value(), betti_numbers(fresh.value().complex).value());
}

TEST(ShrinkingUnion, AgreesWithANewMeasurement) {
  // Large ones among small ones: some are hidden until others go.
  auto balls = test::random_balls(200, 3, 0.02, 0.12);
  const auto large = test::random_balls(10, 4, 0.2, 0.3);
  balls.insert(balls.end(), large.begin(), large.end());
  ShrinkingUnion shrinking = build(balls);
  expect_same(shrinking, balls);
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for (std::size_t n = 0; n < order.size(); n += 15) {
    const std::size_t count = std::min<std::size_t>(15, order.size() - n);
    ASSERT_TRUE(shrinking.remove({order.data() + n, count}).ok());
    expect_same(shrinking, balls);
  }
  EXPECT_EQ(shrinking.volume(), 0);
}

TEST(ShrinkingUnion, UndoesTheLastRemoval) {
  const auto balls = test::random_balls(150, 8, 0.05, 0.2);
  ShrinkingUnion shrinking = build(balls);
  ASSERT_TRUE(shrinking.remove(std::vector<std::uint32_t>{1, 2, 3}).ok());
  const std::vector<double> volumes(shrinking.volumes().begin(), shrinking.volumes().end());
  const BettiNumbers betti = shrinking.betti().value();
  std::vector<std::uint32_t> many(100);
  std::iota(many.begin(), many.end(), 0u);
  ASSERT_TRUE(shrinking.remove(many).ok());
  EXPECT_LT(shrinking.volume(), std::accumulate(volumes.begin(), volumes.end(), 0.0));
  shrinking.undo();
  EXPECT_TRUE(std::equal(volumes.begin(), volumes.end(), shrinking.volumes().begin()));
  EXPECT_EQ(shrinking.betti().value(), betti);
  EXPECT_FALSE(shrinking.holds(2));
  EXPECT_TRUE(shrinking.holds(4));
  shrinking.undo();
  EXPECT_FALSE(shrinking.holds(2));
  expect_same(shrinking, balls);
}

TEST(ShrinkingUnion, OfEqualBallsKeepsOne) {
  ShrinkingUnion shrinking = build(std::vector<Ball>(5, {{1, 2, 3}, 2}));
  const double volume = shrinking.volume();
  for (std::uint32_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(shrinking.remove({&i, 1}).ok());
    EXPECT_NEAR(shrinking.volume(), volume, kSame * volume);
  }
}

/// The cell of the first ball reaches into a corner of its box, outside the ball, and borders there on a ball whose own
/// box does not reach as far. The first ball is nevertheless found.
TEST(ShrinkingUnion, MeasuresABallThatWasCovered) {
  const double radius = std::sqrt(15.92);
  const std::vector<Ball> balls = {
      {{0, 0, 0}, 1}, {{-3.4, 0.6, 0.6}, radius}, {{0.6, -3.4, 0.6}, radius}, {{0.6, 0.6, -3.4}, radius}};
  ShrinkingUnion shrinking = build(balls);
  EXPECT_EQ(shrinking.volumes()[0], 0);
  const std::uint32_t second = 1;
  ASSERT_TRUE(shrinking.remove({&second, 1}).ok());
  EXPECT_GT(shrinking.volumes()[0], 0.05);
  expect_same(shrinking, balls);
}

TEST(ShrinkingUnion, RefusesUnknownBalls) {
  ShrinkingUnion shrinking = build(test::random_balls(5, 1, 0.1, 0.2));
  const double volume = shrinking.volume();
  const std::uint32_t names[] = {0, 5};
  const Status status = shrinking.remove(names);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kUsage);
  EXPECT_THAT(status.error().message, testing::HasSubstr("no ball 5"));
  EXPECT_EQ(shrinking.volume(), volume);
}

}  // namespace
}  // namespace medial_vk
