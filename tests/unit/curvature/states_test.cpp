// What is said where there is no sheet to fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

using test::BallSheet;

bool is_nan(const Point& p) { return std::isnan(p[0]) && std::isnan(p[1]) && std::isnan(p[2]); }

TEST(CurvatureStates, ATubeHasOneCurvature) {
  constexpr int kCount = 400;
  constexpr double kRing = 3, kRadius = 0.5;
  std::vector<Ball> balls;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    balls.push_back({{kRing * std::cos(angle), kRing * std::sin(angle), 1}, kRadius});
  }
  const BoundaryCurvature result = measure_curvature(balls).value();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Point tangent = {-balls[i].centre[1] / kRing, balls[i].centre[0] / kRing, 0};
    for (const TipCurvature& tip : result.balls[i].tips) {
      EXPECT_EQ(tip.state, CurvatureState::kCurve);
      EXPECT_EQ(tip.kappa[0], 1 / kRadius);
      EXPECT_TRUE(std::isnan(tip.kappa[1]));
      EXPECT_TRUE(is_nan(tip.normal));
      // The balls lie symmetrically about each one, except that one at either end may be missing: the axis is turned by
      // less than the ring is from one ball to the next.
      EXPECT_GT(std::fabs(dot(tip.directions[1], tangent)), std::cos(2 * std::numbers::pi / kCount));
    }
    EXPECT_TRUE(std::isnan(result.balls[i].object_angle));
  }
}

TEST(CurvatureStates, SingleBallsArePoints) {
  const std::vector<std::vector<Ball>> sets = {{{{1, 2, 3}, 4}},
                                               {{{1, 2, 3}, 4}, {{1, 2, 3}, 4}},
                                               {{{1, 2, 3}, 4}, {{1.1, 2, 3}, 4}, {{1, 2.1, 3}, 4}},
                                               std::vector<Ball>(8, {{1, 2, 3}, 4})};
  for (const std::vector<Ball>& balls : sets) {
    const BoundaryCurvature result = measure_curvature(balls).value();
    for (const BallCurvature& ball : result.balls) {
      EXPECT_EQ(ball.tips[0].state, CurvatureState::kPoint);
      EXPECT_EQ(ball.tips[1].kappa[0], 0.25);
      EXPECT_EQ(ball.tips[1].kappa[1], 0.25);
      EXPECT_TRUE(is_nan(ball.tips[0].directions[0]));
    }
  }
  EXPECT_TRUE(measure_curvature({}).value().balls.empty());
}

TEST(CurvatureStates, FewBallsAreUnknown) {
  // Four balls, farther apart than a quarter of their radii.
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0, 1, 0}, 1}, {{1, 1, 0}, 1}};
  const BoundaryCurvature result = measure_curvature(balls).value();
  for (const BallCurvature& ball : result.balls) {
    EXPECT_EQ(ball.tips[0].state, CurvatureState::kFew);
    EXPECT_TRUE(std::isnan(ball.tips[0].kappa[0]));
  }
}

TEST(CurvatureStates, BallsInLargerOnesAreNested) {
  BallSheet sheet = test::flat_plate({0, 0, 1}, 2, 0.3, 0.05);
  const BoundaryCurvature before = measure_curvature(sheet.balls).value();
  const std::size_t count = sheet.balls.size();
  sheet.balls.push_back({{0.01, 0.02, 0.2}, 0.1});  // touches the face of the plate from inside
  CurvatureOptions options;
  options.spacing = before.spacing;
  const BoundaryCurvature after = measure_curvature(sheet.balls, options).value();
  EXPECT_EQ(after.balls[count].tips[0].state, CurvatureState::kNested);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(after.balls[i].tips[0].state, before.balls[i].tips[0].state);
    EXPECT_LT(std::fabs(after.balls[i].tips[0].kappa[0]) * before.spacing, 1e-8);
  }
}

TEST(CurvatureStates, SheetsThatCrossAreASeam) {
  BallSheet sheet = test::flat_plate({0, 0, 1}, 2, 0.3, 0.05);
  const BallSheet other = test::flat_plate({1, 0, 0}, 2, 0.3, 0.05);
  sheet.balls.insert(sheet.balls.end(), other.balls.begin(), other.balls.end());
  const BoundaryCurvature result = measure_curvature(sheet.balls).value();
  std::size_t seams = 0;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const double from_seam = std::hypot(sheet.balls[i].centre[0], sheet.balls[i].centre[2]);
    const CurvatureState state = result.balls[i].tips[0].state;
    if (from_seam < 0.5 * result.spacing) {
      EXPECT_EQ(state, CurvatureState::kSeam);
      ++seams;
    }
    // Windows for normals have a radius of two and a half spacings.
    if (from_seam > 3 * result.spacing) {
      EXPECT_TRUE(is_known(state));
      EXPECT_LT(std::fabs(result.balls[i].tips[0].kappa[0]) * result.spacing, 1e-8);
    }
  }
  EXPECT_GT(seams, 20u);
}

TEST(CurvatureStates, ARimCutsWindows) {
  const BallSheet sheet = test::spheroid(2, 1, 0.05);
  const BoundaryCurvature result = measure_curvature(sheet.balls).value();
  std::size_t whole = 0, cut = 0;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const double from_middle = std::hypot(sheet.balls[i].centre[0], sheet.balls[i].centre[1]);
    const CurvatureState state = result.balls[i].tips[0].state;
    if (from_middle < 0.5) {
      EXPECT_EQ(state, CurvatureState::kKnown);
      ++whole;
    }
    if (from_middle > 1.44) {                    // the rim is at 1.47
      EXPECT_NE(state, CurvatureState::kKnown);  // cut, or r kappa, which tends to 1 there, is not below 1
      ++cut;
    }
  }
  EXPECT_GT(whole, 0u);
  EXPECT_GT(cut, 0u);
}

TEST(CurvatureStates, NoiseIsNotTakenForShape) {
  // Radii of noise as great as the spacing: no window agrees with another one, so that nothing is said, or an error
  // that admits 0, the curvature of the plate.
  BallSheet sheet = test::flat_plate({0, 0, 1}, 2, 0.3, 0.05);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> noise(-0.02, 0.02);
  for (Ball& ball : sheet.balls) ball.radius += noise(random);
  std::size_t wrong = 0, all = 0;
  const BoundaryCurvature result = measure_curvature(sheet.balls).value();
  for (const BallCurvature& ball : result.balls) {
    for (const TipCurvature& tip : ball.tips) {
      ++all;
      if (is_known(tip.state) && std::max(std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1])) > tip.error) ++wrong;
    }
  }
  EXPECT_LT(wrong, all / 10);
}

}  // namespace
}  // namespace medial_vk
