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
        EXPECT_LT(tip.error, 2 * share / radius * 1 / (1 - std::numbers::sqrt3 / 3));
      }
    }
    EXPECT_GT(known, sheet.balls.size() / 2);
  }
}

TEST(CurvatureByDifferences, OfAPlateIsZero) {
  const BallSheet sheet = test::flat_plate({0, 0, 1}, 4, 0.3, kPipeSpacing);
  const BoundaryCurvature result = measure_curvature(sheet.balls, differences(), sheet.spokes).value();
  std::size_t known = 0, estimated = 0;
  for (const BallCurvature& ball : result.balls) {
    for (const TipCurvature& tip : ball.tips) {
      if (!is_known(tip.state)) continue;  // at corners, no step stays on the sheet
      ++known;
      if (std::isnan(tip.error)) continue;  // near corners, no other step does
      ++estimated;
      EXPECT_LT(tip.error * kPipeSpacing, 1e-13);
      // Means of equal unit vectors are equal up to rounding; a spacing is shorter than a step.
      EXPECT_LT(std::max(std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1])) * kPipeSpacing, 1e-14);
    }
    EXPECT_NEAR(ball.object_angle, std::numbers::pi / 2, 1e-15);
  }
  EXPECT_GT(known, sheet.balls.size());  // of two tips by ball
  EXPECT_GT(estimated, sheet.balls.size());
}

struct Estimates {
  std::size_t known = 0, above = 0;  // the latter: estimates that are above the true error
  double mean = 0;
};

/// On the balls of a spheroid of semi-axes 2 and 1, with exact spokes.
Estimates estimates_on_spheroid(double spacing) {
  const BallSheet sheet = test::spheroid(2, 1, spacing);
  CurvatureOptions options = differences();
  options.spacing = spacing;
  const BoundaryCurvature result = measure_curvature(sheet.balls, options, sheet.spokes).value();
  Estimates out;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const double from_middle = std::hypot(sheet.balls[i].centre[0], sheet.balls[i].centre[1]);
    if (from_middle > 0.9) continue;  // beyond, some of the longest steps of the coarse set cross the rim, at 1.47
    const auto truth = test::spheroid_curvatures(2, 1, from_middle);
    for (const TipCurvature& tip : result.balls[i].tips) {
      if (!is_known(tip.state)) continue;
      ++out.known;
      out.mean += tip.error;
      if (std::max(std::fabs(tip.kappa[0] - truth[0]), std::fabs(tip.kappa[1] - truth[1])) <= tip.error) ++out.above;
    }
  }
  out.mean /= static_cast<double>(out.known);
  return out;
}

TEST(CurvatureByDifferences, EstimatesContainTheErrorsOfASpheroid) {
  // Errors, and so their estimates, are of the first order in the step where spokes turn unevenly, which they do but
  // for the middle: half the spacing leaves half of them, and of terms of the second order less.
  const Estimates coarse = estimates_on_spheroid(0.08), fine = estimates_on_spheroid(0.04);
  for (const Estimates& estimates : {coarse, fine}) {
    EXPECT_GT(estimates.known, 500u);
    EXPECT_GE(estimates.above, 9 * estimates.known / 10);
  }
  EXPECT_LT(fine.mean, 0.6 * coarse.mean);
  EXPECT_GT(fine.mean, 0);
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
