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
  // By the eight neighbours on either side.
  EXPECT_NEAR(result.spacing, 2 * kRing * std::sin(8 * std::numbers::pi / kCount) / 8, 1e-12);
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
      // The centres lie off a straight line by up to the rise of the ring within four spacings, and on both sides of
      // it by less.
      const double reach = 4 * result.spacing;
      EXPECT_GT(tip.error, 0);
      EXPECT_LE(tip.error, reach * reach / kRing / (kRadius * kRadius));
    }
    EXPECT_TRUE(std::isnan(result.balls[i].object_angle));
  }
}

TEST(CurvatureStates, AStripThatCountsAsACurveHasAnError) {
  // A tube along z of elliptic section, 10 by sqrt(91) spacings: a strip of centres of the half-width 9 / 10.
  constexpr double kAcross = 10, kSquare = 91, kFocus = kAcross * kAcross - kSquare, kHalf = kFocus / kAcross;
  std::vector<Ball> balls;
  test::scatter(kHalf, 30, 0.6, [&](double x, double z) {
    if (std::fabs(x) > kHalf) return;
    balls.push_back({{x, 0, z}, std::sqrt(kSquare * (1 - x * x / kFocus))});
  });
  CurvatureOptions options;
  options.spacing = 1;
  const BoundaryCurvature result = measure_curvature(balls, options).value();
  std::size_t curves = 0;
  double greatest = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const TipCurvature& tip = result.balls[i].tips[0];
    if (tip.state != CurvatureState::kCurve) continue;
    ++curves;
    // The ball at x touches the ellipse (a sin t, b cos t) at sin t = x a / (a^2 - b^2).
    const double sine = balls[i].centre[0] * kAcross / kFocus;
    const double speed = std::sqrt(kAcross * kAcross * (1 - sine * sine) + kSquare * sine * sine);
    const double truth = kAcross * std::sqrt(kSquare) / (speed * speed * speed);
    const double error = std::fabs(tip.kappa[0] - truth);
    EXPECT_LE(error, tip.error);
    EXPECT_LE(tip.error, (1 + 1e-15) * options.spacing / (balls[i].radius * balls[i].radius));
    greatest = std::max(greatest, error / truth);
  }
  EXPECT_GT(curves, balls.size() / 2);
  // In the middle, 1 / b against b / a^2: more by (a^2 - b^2) / b^2.
  EXPECT_NEAR(greatest, kFocus / kSquare, 0.01 * kFocus / kSquare);
}

TEST(CurvatureStates, SparseBallsAreNoPoints) {
  // A plate of balls far apart for the spacing that is given, all of which overlap others.
  const BallSheet plate = test::flat_plate({0, 0, 1}, 20, 5, 1);
  ASSERT_EQ(plate.balls.size(), 400u);
  CurvatureOptions options;
  options.spacing = 0.05;
  const BoundaryCurvature result = measure_curvature(plate.balls, options).value();
  for (const BallCurvature& ball : result.balls) {
    // Their neighbours are too few for a fit, but leave parts of their spheres exposed.
    EXPECT_TRUE(ball.tips[0].state == CurvatureState::kFew || ball.tips[0].state == CurvatureState::kExposed);
    EXPECT_TRUE(std::isnan(ball.tips[1].kappa[0]));
  }
}

TEST(CurvatureStates, OnlyBallsThatOverlapOthersAreNoPoints) {
  using enum CurvatureState;
  CurvatureOptions options;
  options.spacing = 0.05;
  const auto states_of = [&](const std::vector<Ball>& balls) {
    const BoundaryCurvature result = measure_curvature(balls, options).value();
    std::vector<CurvatureState> states;
    states.reserve(result.balls.size());
    for (const BallCurvature& ball : result.balls) {
      states.push_back(ball.tips[0].state);
    }
    return states;
  };
  using testing::ElementsAre;
  EXPECT_THAT(states_of({{{0, 0, 0}, 5}, {{6, 0, 0}, 0.9}}), ElementsAre(kPoint, kPoint));
  EXPECT_THAT(states_of({{{0, 0, 0}, 5}, {{6, 0, 0}, 1.1}}), ElementsAre(kFew, kFew));
  // A ball in a larger one changes nothing for that one, and is none of the boundary itself.
  EXPECT_THAT(states_of({{{0, 0, 0}, 5}, {{3, 0, 0}, 0.5}}), ElementsAre(kPoint, kFew));
  EXPECT_THAT(states_of({{{0, 0, 0}, 5}, {{0, 0, 0}, 0.5}}), ElementsAre(kPoint, kFew));
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
      // The third set alone has centres apart, by 0.1 to 0.1 sqrt(2).
      EXPECT_NEAR(ball.tips[0].error, balls.size() == 3 ? 0.12 / 16 : 0, 0.03 / 16);
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
      EXPECT_TRUE(state == CurvatureState::kSeam || state == CurvatureState::kExposed);
      const double kappa = result.balls[i].tips[0].kappa[0];
      EXPECT_TRUE(std::isnan(kappa) || std::fabs(kappa) * result.spacing < 1e-8);
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
  std::size_t whole = 0, border = 0, cut = 0;
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const double from_middle = std::hypot(sheet.balls[i].centre[0], sheet.balls[i].centre[1]);
    const CurvatureState state = result.balls[i].tips[0].state;
    if (from_middle < 0.5) {
      EXPECT_EQ(state, CurvatureState::kKnown);
      ++whole;
    }
    // The rim is at 1.47: half of a window of five spacings on the boundary, 0.65 times as wide on the sheet, reaches
    // it.
    if (from_middle > 1.44) {
      EXPECT_NE(state, CurvatureState::kKnown);  // cut, or r kappa, which tends to 1 there, is not below 1
      ++border;
      if (state == CurvatureState::kCut) ++cut;
    }
  }
  EXPECT_GT(whole, 0u);
  EXPECT_GT(cut, border / 2);
}

/// Of a plate of spacing 0.05, with noise of up to `share` of it in the radii.
struct NoisyPlate {
  std::size_t known = 0, uncertain = 0, wrong = 0;

  explicit NoisyPlate(double share) {
    BallSheet sheet = test::flat_plate({0, 0, 1}, 2, 0.3, 0.05);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> noise(-0.05 * share, 0.05 * share);
    for (Ball& ball : sheet.balls) ball.radius += noise(random);
    const BoundaryCurvature result = measure_curvature(sheet.balls).value();
    for (const BallCurvature& ball : result.balls) {
      for (const TipCurvature& tip : ball.tips) {
        if (tip.state == CurvatureState::kUncertain) ++uncertain;
        if (!is_known(tip.state)) continue;
        ++known;
        if (std::max(std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1])) > tip.error) ++wrong;
      }
    }
  }
};

TEST(CurvatureStates, NoiseIsNotTakenForShape) {
  // Of 3,200 tips. With two fifths of the spacing, windows disagree by more than a curvature of 0.1 / r.
  const NoisyPlate loud(0.4);
  EXPECT_GT(loud.uncertain, 1600u);
  EXPECT_LE(loud.wrong, loud.known / 10);
  // With less, the error that is said admits 0, the curvature of the plate.
  const NoisyPlate quiet(0.03);
  EXPECT_GT(quiet.known, 1600u);
  EXPECT_LE(quiet.wrong, quiet.known / 10);
}

}  // namespace
}  // namespace medial_vk
