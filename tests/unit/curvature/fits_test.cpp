// Curvatures from centres and radii alone, on balls that are known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

using test::BallSheet;

constexpr double kSheetSpacing = 0.06;

struct WorstErrors {
  double of_kappa = 0, of_normal = 0;
  std::size_t known = 0, all = 0, below = 0;
};

/// Of the balls of a spheroid of semi-axes 2 and 1.
WorstErrors errors_on_spheroid(double spacing) {
  const BallSheet sheet = test::spheroid(2, 1, spacing);
  const BoundaryCurvature result = measure_curvature(sheet.balls, {}, sheet.spokes).value();
  WorstErrors worst;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const double from_middle = std::hypot(sheet.balls[i].centre[0], sheet.balls[i].centre[1]);
    if (from_middle > 1) continue;  // the rim, at 1.47, cuts the windows of the coarse set beyond
    const auto truth = test::spheroid_curvatures(2, 1, from_middle);
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = result.balls[i].tips[side];
      ++worst.all;
      if (!is_known(tip.state)) continue;
      ++worst.known;
      const double error = std::max(std::fabs(tip.kappa[0] - truth[0]), std::fabs(tip.kappa[1] - truth[1]));
      if (error <= tip.error) ++worst.below;
      worst.of_kappa = std::max(worst.of_kappa, error);
      const Point& spoke = side == 0 ? sheet.spokes[i].a : sheet.spokes[i].b;
      worst.of_normal = std::max(worst.of_normal, length(tip.normal - spoke));
    }
  }
  return worst;
}

TEST(Curvature, OfASpheroidConverges) {
  // The polynomials leave terms of the fifth degree, so that curvatures err by the third power of the width of a window
  // or less, and spokes by the fourth: by an eighth and a sixteenth, for half of the spacing. A half of that is left
  // for the choice of windows, whose widths differ by sqrt(2).
  const WorstErrors coarse = errors_on_spheroid(kSheetSpacing), fine = errors_on_spheroid(kSheetSpacing / 2);
  EXPECT_LT(fine.of_kappa, coarse.of_kappa / 4);
  EXPECT_LT(fine.of_normal, coarse.of_normal / 8);
  for (const WorstErrors& errors : {coarse, fine}) {
    EXPECT_EQ(errors.known, errors.all);
    EXPECT_GE(errors.below, 9 * errors.known / 10);
  }
}

TEST(Curvature, OfAPipeHasSignsAndDirections) {
  constexpr double kInner = 8, kOuter = 10;
  const BallSheet sheet = test::pipe_wall(kInner, kOuter, 0.25);
  const BoundaryCurvature result = measure_curvature(sheet.balls, {}, sheet.spokes).value();
  std::size_t known = 0;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const BallCurvature& ball = result.balls[i];
    if (ball.tips[0].state != CurvatureState::kKnown || ball.tips[1].state != CurvatureState::kKnown) continue;
    ++known;
    // The height of a circle of radius R leaves x^6 / (16 R^5) to a polynomial of degree 5, of which less than W^4 x^2
    // times that factor is taken for curvature, in a window of radius W: an error of W^4 / (8 R^5), twice, since the
    // sheet is fitted so, too.
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = ball.tips[side];
      const double radius = side == 0 ? kOuter : kInner, bound = std::pow(tip.window, 4) / (4 * std::pow(radius, 5));
      EXPECT_NEAR(tip.kappa[0], side == 0 ? 1 / kOuter : 0, bound);
      EXPECT_NEAR(tip.kappa[1], side == 0 ? 0 : -1 / kInner, bound);
      // A form that is wrong by e turns its axes by e over the difference of the curvatures.
      const double turn = 2 * bound * radius;
      EXPECT_NEAR(std::fabs(tip.directions[side == 0 ? 1 : 0][2]), 1, turn);
      EXPECT_NEAR(tip.directions[side == 0 ? 0 : 1][2], 0, turn);
      EXPECT_NEAR(dot(tip.directions[0], tip.normal), 0, 1e-12);
    }
    EXPECT_NEAR(ball.object_angle, std::numbers::pi / 2, 1e-3);
  }
  EXPECT_GT(known, sheet.balls.size() / 4);
}

TEST(Curvature, OfAPlateIsZero) {
  const BallSheet sheet = test::flat_plate({0, 0.6, 0.8}, 2, 0.3, kSheetSpacing);
  const BoundaryCurvature result = measure_curvature(sheet.balls).value();
  for (const BallCurvature& ball : result.balls) {
    for (const TipCurvature& tip : ball.tips) {
      ASSERT_TRUE(is_known(tip.state));
      // Coefficients lose half of the digits, 10^-8, of heights as long as a window; spacings are shorter.
      EXPECT_LT(std::max(std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1])) * kSheetSpacing, 1e-8);
    }
    EXPECT_NEAR(ball.object_angle, std::numbers::pi / 2, 1e-7);
  }
}

TEST(Curvature, EstimatesTheSpacing) {
  const BallSheet sheet = test::flat_plate({0, 0, 1}, 2, 0.3, kSheetSpacing);
  // A disc of 16 cells of a jittered grid has between 16 - d and 16 + d balls, d a fraction of those at its border of
  // some 14 cells; the median over all balls is closer than a tenth.
  EXPECT_NEAR(measure_curvature(sheet.balls).value().spacing, kSheetSpacing, 0.1 * kSheetSpacing);
  CurvatureOptions options;
  options.spacing = 0.07;
  EXPECT_EQ(measure_curvature(sheet.balls, options).value().spacing, 0.07);
}

}  // namespace
}  // namespace medial_vk
