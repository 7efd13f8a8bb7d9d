// A union of balls that are added, removed and moved, against the same balls measured at once.
#include "medial_vk/dynamic_union.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

// Both results are sums of at most 40 volumes of at most 0.4, each with some hundred roundings.
constexpr double kTolerance = 1e-11;

double volume_at_once(const DynamicUnion& balls) {
  std::vector<Ball> all;
  for (std::uint32_t i = 0; i < balls.slots(); ++i) {
    if (balls.holds(i)) all.push_back(balls.ball(i));
  }
  return measure_ball_union(all).value().volume;
}

/// Random changes, most of them kept and some undone.
class Sequence {
 public:
  Sequence(unsigned seed, bool on_a_grid)
      : random_(seed), on_a_grid_(on_a_grid), balls_(std::move(DynamicUnion::build(64, 2)).value()) {}

  void step() {
    const double before = balls_.volume();
    const std::uint32_t kind = balls_.size() < 5 ? 0 : balls_.size() > 40 ? 1 : random_() % 4;
    double expected = before;
    if (kind == 0) {
      const Ball ball = random_ball();
      expected += balls_.gain(ball).value();
      ASSERT_TRUE(balls_.add(ball).ok());
      EXPECT_NEAR(balls_.volume(), expected, kTolerance);
    } else if (kind == 1) {
      const std::uint32_t slot = random_slot();
      expected -= balls_.loss(slot).value();
      ASSERT_TRUE(balls_.remove(slot).ok());
      EXPECT_NEAR(balls_.volume(), expected, kTolerance);
    } else {
      const std::uint32_t slot = random_slot();
      ASSERT_TRUE(balls_.move(slot, kind == 2 ? nudged(balls_.ball(slot)) : random_ball()).ok());
    }
    EXPECT_NEAR(balls_.volume(), volume_at_once(balls_), kTolerance);
    if (random_() % 3 != 0) return;
    balls_.undo();
    EXPECT_EQ(balls_.volume(), before);
    EXPECT_NEAR(balls_.volume(), volume_at_once(balls_), kTolerance);
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  Ball random_ball() {
    Ball ball = {{uniform(), uniform(), uniform()}, 0.05 + 0.4 * uniform() * uniform()};
    if (!on_a_grid_) return ball;
    for (double& x : ball.centre) x = std::round(4 * x) / 4;
    ball.radius = std::round(8 * ball.radius) / 8 + 0.125;
    return ball;
  }
  Ball nudged(Ball ball) {
    for (double& x : ball.centre) x += 0.05 * (uniform() - 0.5);
    return ball;
  }
  std::uint32_t random_slot() {
    for (;;) {
      const auto slot = static_cast<std::uint32_t>(random_() % balls_.slots());
      if (balls_.holds(slot)) return slot;
    }
  }

  std::mt19937 random_;
  bool on_a_grid_;
  DynamicUnion balls_;
};

TEST(DynamicUnion, IsTheUnionOfWhatIsThere) {
  for (unsigned seed = 0; seed < 40 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    // On a grid balls coincide, contain each other, and meet in groups of four and more.
    Sequence sequence(seed, seed % 2 == 1);
    for (int n = 0; n < 200 && !testing::Test::HasFailure(); ++n) sequence.step();
  }
}

TEST(DynamicUnion, ExposureIsTheDerivativeOfTheVolume) {
  DynamicUnion balls = std::move(DynamicUnion::build(8, 2)).value();
  const std::vector<Ball> some = {
      {{0, 0, 0}, 0.5}, {{0.4, 0.1, 0}, 0.4}, {{0.1, 0.5, 0.2}, 0.45}, {{0.2, 0.2, 0.5}, 0.3}};
  for (const Ball& ball : some) ASSERT_TRUE(balls.add(ball).ok());
  const BallUnion measured = measure_ball_union(some).value();
  const double h = 1e-5;  // second derivative of order 1: central differences err by 1e-10, rounding by 1e-11
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Exposure exposure = balls.exposure(i);
    const Ball ball = balls.ball(i);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(measured.vectors[i][k], exposure.vector[k], 1e-13);
    const auto volume_with = [&](const Ball& other) {
      EXPECT_TRUE(balls.move(i, other).ok());
      const double volume = balls.volume();
      balls.undo();
      return volume;
    };
    for (std::size_t k = 0; k < 4; ++k) {
      Ball more = ball, less = ball;
      (k < 3 ? more.centre[k] : more.radius) += h;
      (k < 3 ? less.centre[k] : less.radius) -= h;
      const double slope = (volume_with(more) - volume_with(less)) / (2 * h);
      EXPECT_NEAR(slope, k < 3 ? exposure.vector[k] : exposure.area, 1e-8) << "ball " << i << ", direction " << k;
    }
  }
}

TEST(DynamicUnion, VerticesLieOnThreeSpheres) {
  DynamicUnion balls = std::move(DynamicUnion::build(8, 2)).value();
  const std::vector<Ball> some = {{{0, 0, 0}, 0.5}, {{0.4, 0, 0}, 0.5}, {{0.2, 0.4, 0}, 0.5}};
  for (const Ball& ball : some) ASSERT_TRUE(balls.add(ball).ok());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::vector<Point> vertices = balls.vertices(i).value();
    ASSERT_EQ(vertices.size(), 2u);
    for (const Point& v : vertices) {
      for (const Ball& ball : some) {
        const double distance = std::hypot(v[0] - ball.centre[0], v[1] - ball.centre[1], v[2] - ball.centre[2]);
        EXPECT_NEAR(distance, ball.radius, 1e-14);
      }
    }
  }
}

TEST(DynamicUnion, TakesOneBallAsItIs) {
  DynamicUnion balls = std::move(DynamicUnion::build(1, 1e6)).value();
  ASSERT_TRUE(balls.add({{3e5, 0, -2e5}, 2}).ok());
  EXPECT_NEAR(balls.volume(), 4 * std::numbers::pi / 3 * 8, 1e-13);
  EXPECT_NEAR(balls.exposure(0).area, 4 * std::numbers::pi * 4, 1e-13);
  EXPECT_EQ(balls.gain({{3e5, 0, -2e5}, 1}).value(), 0);
}

/// In another order and at another scale than before, and with other cells in the memory.
TEST(DynamicUnion, ClearedItIsAsANewOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Ball> some;
  for (int i = 0; i < 40; ++i) some.push_back({{uniform(random), uniform(random), uniform(random)}, 0.4});
  DynamicUnion kept = std::move(DynamicUnion::build(40, 2)).value();
  for (const Ball& ball : some) ASSERT_TRUE(kept.add(ball).ok());
  ASSERT_TRUE(kept.make_room().ok());
  ASSERT_TRUE(kept.remove(3).ok());
  EXPECT_EQ(kept.clear(NAN).error().code, ErrorCode::kUsage);
  EXPECT_EQ(kept.size(), 39u);
  ASSERT_TRUE(kept.clear(5).ok());
  EXPECT_EQ(kept.size(), 0u);
  EXPECT_EQ(kept.slots(), 0u);
  EXPECT_EQ(kept.volume(), 0);
  EXPECT_TRUE(kept.changed().empty());
  kept.undo();  // nothing
  EXPECT_EQ(kept.size(), 0u);
  DynamicUnion fresh = std::move(DynamicUnion::build(40, 5)).value();
  for (std::size_t i = some.size(); i-- > 0;) {
    ASSERT_EQ(kept.add(some[i]).value(), fresh.add(some[i]).value());
    EXPECT_EQ(kept.volume(), fresh.volume());
  }
  for (std::uint32_t slot = 0; slot < 40; ++slot) {
    EXPECT_EQ(kept.exposure(slot).area, fresh.exposure(slot).area);
    EXPECT_EQ(kept.loss(slot).value(), fresh.loss(slot).value());
  }
}

/// The gains of several balls are those of each one, on any number of threads; on a grid, ties are frequent.
TEST(DynamicUnion, GainsOfSeveralBallsAreThoseOfEach) {
  std::mt19937 random(5);
  const auto on_grid = [&] { return 0.25 * static_cast<double>(random() % 5); };
  std::vector<Ball> some;
  for (int n = 0; n < 90; ++n) {
    const double x = on_grid(), y = on_grid(), z = on_grid();
    some.push_back({{x, y, z}, 0.1 + 0.1 * static_cast<double>(random() % 4)});
  }
  for (const unsigned threads : {1u, 3u, 40u}) {
    SCOPED_TRACE(threads);
    DynamicUnion balls = std::move(DynamicUnion::build(40, 2, threads)).value();
    for (std::size_t n = 0; n < 30; ++n) ASSERT_TRUE(balls.add(some[n]).ok());
    const std::vector<double> gains = balls.gains(some).value();
    ASSERT_EQ(gains.size(), some.size());
    for (std::size_t n = 0; n < some.size(); ++n) EXPECT_EQ(gains[n], balls.gain(some[n]).value());
    EXPECT_GT(*std::ranges::max_element(gains), 0);
    EXPECT_TRUE(balls.gains({}).value().empty());
    EXPECT_EQ(balls.gains(std::vector<Ball>{some[0], {{0, 0, 0}, NAN}}).error().code, ErrorCode::kUsage);
  }
}

/// Moves whose cells are computed in the end, between other changes: the union is that of its balls, and each exposure
/// is that of a union in which the ball is there.
TEST(DynamicUnion, ShiftsAreMovesOnceSettled) {
  std::mt19937 random(11);
  const auto coordinate = [&](bool on_a_grid) {
    const double x = std::uniform_real_distribution<double>(0, 1)(random);
    return on_a_grid ? std::round(4 * x) / 4 : x;
  };
  const auto any_ball = [&](bool on_a_grid) {
    Ball ball = {{coordinate(on_a_grid), coordinate(on_a_grid), coordinate(on_a_grid)}, 0};
    ball.radius = 0.125 + 0.25 * coordinate(on_a_grid);
    return ball;
  };
  for (const bool on_a_grid : {false, true}) {
    for (const unsigned threads : {1u, 3u}) {
      SCOPED_TRACE(testing::Message() << "on a grid: " << on_a_grid << ", threads: " << threads);
      DynamicUnion balls = std::move(DynamicUnion::build(40, 2, threads)).value();
      for (int n = 0; n < 30; ++n) ASSERT_TRUE(balls.add(any_ball(on_a_grid)).ok());
      for (int round = 0; round < 12; ++round) {
        for (int n = 0; n < 6; ++n) {
          const auto slot = static_cast<std::uint32_t>(random() % balls.slots());
          const Ball to = random() % 4 == 0 ? balls.ball(slot) : any_ball(on_a_grid);
          const Exposure there = balls.exposure_at(slot, to).value();
          DynamicUnion moved = std::move(DynamicUnion::build(40, 2)).value();
          for (std::uint32_t s = 0; s < balls.slots(); ++s) ASSERT_TRUE(moved.add(s == slot ? to : balls.ball(s)).ok());
          EXPECT_NEAR(there.area, moved.exposure(slot).area, kTolerance);
          for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(there.vector[k], moved.exposure(slot).vector[k], kTolerance);
          if (random() % 3 == 0) continue;
          ASSERT_TRUE(balls.shift(slot, to).ok());
        }
        ASSERT_TRUE(balls.settle().ok());
        EXPECT_NEAR(balls.volume(), volume_at_once(balls), kTolerance);
        const double settled = balls.volume();
        balls.undo();
        EXPECT_EQ(balls.volume(), settled);
        ASSERT_TRUE(balls.move(static_cast<std::uint32_t>(round), any_ball(on_a_grid)).ok());
        EXPECT_NEAR(balls.volume(), volume_at_once(balls), kTolerance);
        balls.undo();
        EXPECT_EQ(balls.volume(), settled);
      }
    }
  }
}

/// An exposure that was measured among others than are there now leaves nothing behind.
TEST(DynamicUnion, ShiftsDoNotKeepCellsOfAnEarlierState) {
  DynamicUnion balls = std::move(DynamicUnion::build(4, 7)).value();
  for (const double x : {0.0, 5.0}) ASSERT_TRUE(balls.add({{x, 0, 0}, 1}).ok());
  const Ball to = {{0.1, 0, 0}, 1};
  ASSERT_TRUE(balls.exposure_at(0, to).ok());
  ASSERT_TRUE(balls.shift(1, {{1.1, 0, 0}, 1}).ok());
  ASSERT_TRUE(balls.shift(0, to).ok());
  ASSERT_TRUE(balls.settle().ok());
  EXPECT_NEAR(balls.volume(), volume_at_once(balls), kTolerance);
  ASSERT_TRUE(balls.add({{0, 0.5, 0}, 1}).ok());
  ASSERT_TRUE(balls.exposure_at(0, {{0, 0, 0}, 1}).ok());
  balls.undo();
  ASSERT_TRUE(balls.shift(0, {{0, 0, 0}, 1}).ok());
  ASSERT_TRUE(balls.settle().ok());
  EXPECT_NEAR(balls.volume(), volume_at_once(balls), kTolerance);
}

TEST(DynamicUnion, ShiftsNameTheirSlotsAndWaitForSettle) {
  DynamicUnion balls = std::move(DynamicUnion::build(4, 3)).value();
  for (const double x : {0.0, 0.5, 2.5}) ASSERT_TRUE(balls.add({{x, 0, 0}, 0.5}).ok());
  const double area = balls.exposure_at(2, balls.ball(2)).value().area;
  EXPECT_EQ(balls.shift(3, {{0, 0, 0}, 1}).error().message, "no ball in slot 3");
  EXPECT_EQ(balls.exposure_at(0, {{9, 0, 0}, 1}).error().code, ErrorCode::kUsage);
  ASSERT_TRUE(balls.shift(0, {{0.1, 0, 0}, 0.5}).ok());
  EXPECT_EQ(balls.gain({{0, 0, 0}, 1}).error().message, "after shift(), settle() comes first");
  EXPECT_EQ(balls.move(1, {{0, 0, 0}, 1}).error().code, ErrorCode::kUsage);
  ASSERT_TRUE(balls.shift(0, {{0.2, 0, 0}, 0.5}).ok());
  ASSERT_TRUE(balls.settle().ok());
  EXPECT_EQ(std::vector<std::uint32_t>(balls.changed().begin(), balls.changed().end()),
            (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(balls.exposure(2).area, area);
  EXPECT_TRUE(balls.settle().ok());
}

TEST(DynamicUnion, NamesWhatItCannotTake) {
  DynamicUnion balls = std::move(DynamicUnion::build(1, 1)).value();
  EXPECT_EQ(DynamicUnion::build(1, 0).error().code, ErrorCode::kUsage);
  EXPECT_EQ(DynamicUnion::build(1, INFINITY).error().code, ErrorCode::kUsage);
  EXPECT_EQ(balls.remove(0).error().message, "no ball in slot 0");
  EXPECT_EQ(balls.move(7, {{0, 0, 0}, 1}).error().message, "no ball in slot 7");
  EXPECT_EQ(balls.loss(0).error().code, ErrorCode::kUsage);
  EXPECT_EQ(balls.add({{0, 2, 0}, 0.5}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(balls.gain({{0, NAN, 0}, 0.5}).error().code, ErrorCode::kUsage);
  ASSERT_TRUE(balls.add({{0, 0, 0}, 0.5}).ok());
  EXPECT_EQ(balls.add({{0, 0, 0}, 0.5}).error().message, "the union is full: its `capacity` is 1");
  EXPECT_EQ(balls.size(), 1u);
}

}  // namespace
}  // namespace medial_vk
