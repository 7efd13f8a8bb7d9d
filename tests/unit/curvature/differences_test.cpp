// The source's finite differences of given spokes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

using test::BallSheet;

constexpr double kPipeInner = 8, kPipeOuter = 10, kPipeMiddle = 9, kPipeSpacing = 0.2;

CurvatureOptions differences() {
  CurvatureOptions options;
  options.method = CurvatureMethod::kDifferences;
  options.spacing = kPipeSpacing;
  return options;
}

/// Whether a ball of the wall is two steps or more away from its border: means are then of balls on all sides.
bool is_inside(const Ball& ball) {
  const double reach = 0.6 * kPipeMiddle - 2 * 6 * kPipeSpacing;
  return std::fabs(ball.centre[2]) < reach &&
         std::fabs(std::atan2(ball.centre[1], ball.centre[0])) < reach / kPipeMiddle;
}

TEST(CurvatureByDifferences, OfAPipe) {
  const BallSheet sheet = test::pipe_wall(kPipeInner, kPipeOuter, kPipeSpacing);
  const CurvatureOptions options = differences();
  // Steps turn the normal by up to t = 1.2 step / R, and the tangent plane of two steps by as much: curvatures err by
  // that share. The mean at the end of the second step lies off it by up to the radius of its window, a quarter of the
  // step.
  const double share = 1.2 * options.step * kPipeSpacing / kPipeMiddle + 0.25;
  for (const bool smooth : {false, true}) {
    CurvatureOptions chosen = options;
    chosen.smooth = smooth;
    const BoundaryCurvature result = measure_curvature(sheet.balls, chosen, sheet.spokes).value();
    std::size_t known = 0;
    for (std::size_t i = 0; i < result.balls.size(); ++i) {
      if (!is_inside(sheet.balls[i])) continue;
      const BallCurvature& ball = result.balls[i];
      for (std::size_t side = 0; side < 2; ++side) {
        const TipCurvature& tip = ball.tips[side];
        if (!is_known(tip.state)) continue;
        ++known;
        const double radius = side == 0 ? kPipeOuter : kPipeInner;
        EXPECT_NEAR(tip.kappa[0], side == 0 ? 1 / kPipeOuter : 0, share / radius);
        EXPECT_NEAR(tip.kappa[1], side == 0 ? 0 : -1 / kPipeInner, share / radius);
        EXPECT_NEAR(dot(tip.directions[0], tip.normal), 0, 1e-12);
        EXPECT_TRUE(std::isnan(tip.error));
      }
    }
    EXPECT_GT(known, sheet.balls.size() / 2);
  }
}

TEST(CurvatureByDifferences, OfAPlateIsZero) {
  const BallSheet sheet = test::flat_plate({0, 0, 1}, 4, 0.3, kPipeSpacing);
  const BoundaryCurvature result = measure_curvature(sheet.balls, differences(), sheet.spokes).value();
  std::size_t known = 0;
  for (const BallCurvature& ball : result.balls) {
    for (const TipCurvature& tip : ball.tips) {
      if (!is_known(tip.state)) continue;  // at corners, no step stays on the sheet
      ++known;
      // Means of equal unit vectors are equal up to rounding; a spacing is shorter than a step.
      EXPECT_LT(std::max(std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1])) * kPipeSpacing, 1e-14);
    }
    EXPECT_NEAR(ball.object_angle, std::numbers::pi / 2, 1e-15);
  }
  EXPECT_GT(known, sheet.balls.size());  // of two tips by ball
}

TEST(CurvatureByDifferences, SpokesThatCrossFailTheRadialCondition) {
  // With 2.5 times the radius of the ring of centres, inward spokes meet before they end: r kappa_r = 2.5 there.
  BallSheet sheet = test::pipe_wall(kPipeInner, kPipeOuter, kPipeSpacing);
  for (Ball& ball : sheet.balls) ball.radius = 2.5 * kPipeMiddle;
  std::size_t focal = 0;
  const BoundaryCurvature result = measure_curvature(sheet.balls, differences(), sheet.spokes).value();
  for (const BallCurvature& ball : result.balls) {
    EXPECT_NE(ball.tips[0].state, CurvatureState::kFocal);
    EXPECT_FALSE(is_known(ball.tips[1].state));
    if (ball.tips[1].state == CurvatureState::kFocal) ++focal;
    EXPECT_TRUE(std::isnan(ball.tips[1].kappa[0]));
  }
  EXPECT_GT(focal, sheet.balls.size() / 2);
}

TEST(CurvatureByDifferences, FewBallsAreUnknown) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}, {{0.2, 0, 0}, 1}};
  const std::vector<SpokePair> spokes(2, {{0, 0, 1}, {0, 0, -1}});
  const BoundaryCurvature result = measure_curvature(balls, differences(), spokes).value();
  for (const BallCurvature& ball : result.balls) {
    EXPECT_EQ(ball.tips[0].state, CurvatureState::kFew);
  }
}

}  // namespace
}  // namespace medial_vk
