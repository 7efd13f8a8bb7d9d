// Covers that follow a mesh: certified in every frame by the reference, and invariant where the frame is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "medial_vk/ball_union.h"
#include "unit/cover_following/cover_example.h"

namespace medial_vk {
namespace {

class CoverInMotion : public testing::TestWithParam<std::tuple<test::Motion, std::uint32_t>> {};

TEST_P(CoverInMotion, EveryFrameIsCovered) {
  const auto [motion, steps] = GetParam();
  for (const CoverExample& example : {covered_torus(), covered_l_shape()}) {
    CoverFollower follower = example.follower({.steps = steps});
    expect_cover(follower, example.mesh, example.rest(), "rest");
    for (const double time : {0.5, 1.0}) {
      const CoverFrame frame = test::moved_vertices(example.rest(), motion, time);
      ASSERT_TRUE(follower.update(frame).ok());
      expect_cover(follower, example.mesh, frame, std::string(test::name_of(motion)) + " " + std::to_string(time));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CoverInMotion,
                         testing::Combine(testing::ValuesIn(test::kMotions), testing::Values(0u, 2u)),
                         [](const auto& parameters) {
                           return std::string(test::name_of(std::get<0>(parameters.param))) +
                                  (std::get<1>(parameters.param) > 0 ? "_with_steps" : "");
                         });

TEST(CoverFollower, TheRestPoseAsAFrameChangesNothing) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower({.steps = 1});
  const std::vector<Ball> rest = balls_of(follower);
  ASSERT_TRUE(follower.update(example.rest()).ok());
  EXPECT_EQ(difference_of(follower.balls(), rest), 0);
}

TEST(CoverFollower, FramesDoNotDependOnEachOther) {
  const CoverExample example = covered_l_shape();
  CoverFollower seen = example.follower({.steps = 1}), fresh = example.follower({.steps = 1});
  ASSERT_TRUE(seen.update(test::moved_vertices(example.rest(), test::Motion::kRipple, 1)).ok());
  const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(seen.update(frame).ok());
  ASSERT_TRUE(fresh.update(frame).ok());
  EXPECT_EQ(difference_of(seen.balls(), fresh.balls()), 0);
}

/// A rotation, then a shift; or a reflection in a plane.
Point turned_point(const Point& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {c * p[0] - s * p[1] + 3, s * p[0] + c * p[1] - 5, p[2] + 0.25};
}
Point mirrored_point(const Point& p) { return {-p[0], p[1], p[2]}; }

/// Coordinates are below 8, so their rounding is below 1e-15. Centres sum up to a thousand of them, with shares of up
/// to a thousand: the distance of a centre from a small patch, in sizes of the patch.
constexpr double kRoundingOfCentres = 1e-9;

void expect_cover_moves_with(Point (*move)(const Point&), bool turned) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower({.surface_only = true});
  for (const double time : {0.0, 0.6}) {
    const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kBend, time);
    ASSERT_TRUE(follower.update(frame).ok());
    std::vector<Ball> expected = balls_of(follower);
    for (Ball& ball : expected) {
      if (ball.radius > 0) ball.centre = move(ball.centre);  // others stay where they were given
    }
    CoverFrame image = frame;
    std::ranges::transform(image, image.begin(), move);
    ASSERT_TRUE(follower.update(image).ok());
    EXPECT_LE(difference_of(follower.balls(), expected), kRoundingOfCentres) << time;
    CoverFollower whole = example.follower();
    ASSERT_TRUE(whole.update(image).ok());
    expect_cover(whole, example.mesh, image, "image", turned);
  }
}

TEST(CoverFollower, BallsTurnWithTheFrame) { expect_cover_moves_with(turned_point, false); }

TEST(CoverFollower, BallsOfAMirroredFrameAreMirrored) { expect_cover_moves_with(mirrored_point, true); }

TEST(CoverFollower, StepsLessenTheVolume) {
  const CoverExample example = covered_torus();
  const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, 1);
  double before = std::numeric_limits<double>::infinity();
  for (const std::uint32_t steps : {0u, 1u, 4u}) {
    CoverFollower follower = example.follower({.surface_only = true, .steps = steps});
    ASSERT_TRUE(follower.update(frame).ok());
    const double volume = follower.measure().value().ball_volume;
    EXPECT_LT(volume, before) << steps;
    before = volume;
  }
}

TEST(CoverFollower, TightenedCoversAreSmallerAndFollowLaterFrames) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower();
  const std::vector<Ball> rest = balls_of(follower);
  const CoverFrame bent = test::moved_vertices(example.rest(), test::Motion::kBend, 1);
  ASSERT_TRUE(follower.update(bent).ok());
  const double before = follower.measure().value().ball_volume;
  ASSERT_TRUE(follower.tighten().ok());
  EXPECT_LT(follower.measure().value().ball_volume, before);
  expect_cover(follower, example.mesh, bent, "tightened");
  const std::vector<Ball> tight = balls_of(follower);
  const CoverFrame next = test::moved_vertices(example.rest(), test::Motion::kBend, 0.7);
  ASSERT_TRUE(follower.update(next).ok());
  expect_cover(follower, example.mesh, next, "after it");
  ASSERT_TRUE(follower.reset().ok());
  EXPECT_EQ(difference_of(follower.balls(), rest), 0);
}

TEST(CoverFollower, ATightenedFrameIsTheSameAsTheNextOne) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower(), loose = example.follower();
  const CoverFrame bent = test::moved_vertices(example.rest(), test::Motion::kBend, 1);
  ASSERT_TRUE(follower.update(bent).ok());
  ASSERT_TRUE(follower.tighten().ok());
  const double tight = follower.measure().value().ball_volume;
  ASSERT_TRUE(follower.update(bent).ok());
  // Centres are kept up to 1e-9 of a trace (docs/theory.md), times the distance from the patches.
  EXPECT_NEAR(follower.measure().value().ball_volume, tight, 1e-6 * tight);
  const CoverFrame next = test::moved_vertices(example.rest(), test::Motion::kBend, 0.9);
  ASSERT_TRUE(follower.update(next).ok());
  ASSERT_TRUE(loose.update(next).ok());
  EXPECT_LT(follower.measure().value().ball_volume, loose.measure().value().ball_volume);
}

TEST(CoverFollower, TrianglesThatAreAPointAreDividedToo) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower();
  CoverFrame frame = example.rest();
  for (Point& p : frame) {
    if (p[0] > 0.2) p = {0.016236256985133313, 0.1476560876222602, -0.10976116286324372};
  }
  ASSERT_TRUE(follower.update(frame).ok());
  ASSERT_TRUE(follower.tighten().ok());
  ASSERT_TRUE(follower.update(frame).ok());
  const std::vector<Ball> before = balls_of(follower);
  for (Point& p : frame) p[0] += 100;
  ASSERT_TRUE(follower.update(frame).ok());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(before[i].radius > 0)) continue;
    EXPECT_NEAR(follower.balls()[i].centre[0], before[i].centre[0] + 100, 1e-6) << i;
  }
}

TEST(CoverFollower, ResultsDoNotDependOnThreads) {
  const CoverExample example = covered_torus();
  std::vector<std::vector<Ball>> results;
  for (const unsigned threads : {1u, 3u}) {
    CoverFollower follower = example.follower({.steps = 1, .threads = threads});
    ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), test::Motion::kTwist, 1)).ok());
    ASSERT_TRUE(follower.tighten().ok());
    results.push_back(balls_of(follower));
  }
  EXPECT_EQ(difference_of(results[0], results[1]), 0);
}

TEST(CoverFollower, ACavityIsFilled) {
  // Balls along the boundary of a box leave its middle out.
  const CoverExample example(test::make_box({2, 2, 2}), 0.3, true);
  const Point middle = {1, 1, 1};
  const CoverFollower surface = example.follower({.surface_only = true});
  EXPECT_EQ(surface.state(), CoverState::kSurface);
  ASSERT_FALSE(any_holds(surface.balls(), middle));
  ASSERT_GT(betti_numbers(measure_ball_union(surface.balls(), {0, true}).value().complex).value().cavities, 0u);
  const CoverFollower whole = example.follower();
  EXPECT_TRUE(any_holds(whole.balls(), middle));
  expect_cover(whole, example.mesh, example.rest(), "one that grew");
}

TEST(CoverFollower, ASpareBallFillsACavity) {
  CoverExample example(test::make_box({2, 2, 2}), 0.3, true);
  example.balls.push_back({{5, 5, 5}, 0});
  CoverFollower surface = example.follower({.surface_only = true}), whole = example.follower();
  for (const double time : {0.0, 1.0}) {
    const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, time);
    ASSERT_TRUE(surface.update(frame).ok());
    ASSERT_TRUE(whole.update(frame).ok());
    EXPECT_EQ(surface.balls().back().radius, 0);
    std::vector<Ball> placed;
    for (std::size_t i = 0; i < example.balls.size(); ++i) {
      if (surface.balls()[i].radius == 0 && whole.balls()[i].radius > 0) placed.push_back(whole.balls()[i]);
    }
    EXPECT_TRUE(any_holds(placed, {1, 1, 1})) << time;
    expect_cover(whole, example.mesh, frame, "a spare ball");
  }
}

TEST(CoverFollower, ACavityOfTheSolidStaysEmpty) {
  // Balls along the middle of the wall, each of which holds both sides of it.
  CoverExample example(test::make_shell(400, 200), 1);
  example.balls.clear();
  constexpr int kCount = 300;
  for (int i = 0; i < kCount; ++i) {
    const double z = 1 - (2 * i + 1.0) / kCount, across = std::sqrt(1 - z * z), angle = 2.399963 * i;
    example.balls.push_back({0.85 * Point{across * std::cos(angle), across * std::sin(angle), z}, 0.3});
  }
  CoverFollower follower = example.follower();
  for (const double time : {0.0, 1.0}) {
    const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, time);
    ASSERT_TRUE(follower.update(frame).ok());
    EXPECT_FALSE(any_holds(follower.balls(), {0, 0, 0})) << time;
    const auto complex = measure_ball_union(follower.balls(), {0, true}).value().complex;
    EXPECT_EQ(betti_numbers(complex).value().cavities, 1u) << time;
    expect_cover(follower, example.mesh, frame, "shell");
  }
}

TEST(CoverFollower, MeasuresAreThoseOfTheFrame) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower();
  const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(follower.update(frame).ok());
  Mesh moved = example.mesh.prepared().mesh;
  moved.vertices = frame;
  const CoverFollowMeasures measures = follower.measure().value();
  EXPECT_NEAR(measures.solid_volume, test::signed_volume(moved), 1e-9);
  EXPECT_EQ(measures.ball_volume, measure_ball_union(follower.balls()).value().volume);
  EXPECT_GT(measures.added(), 0);
}

// Where parts overlap, they count twice; the balls that cover both have less volume than that.
TEST(CoverFollower, TheVolumeOfOverlappingPartsIsNotKnown) {
  Mesh two = test::make_sphere(1, 300);
  test::append(two, test::moved(test::make_sphere(1, 300), {3, 0, 0}));
  CoverExample example(std::move(two), 2);
  example.balls = {{{0, 0, 0}, 1.01}, {{3, 0, 0}, 1.01}};
  CoverFollower follower = example.follower();
  const double at_rest = follower.measure().value().solid_volume;
  EXPECT_NEAR(at_rest, 2 * test::signed_volume(test::make_sphere(1, 300)), 1e-12);
  CoverFrame frame = example.rest();
  for (Point& p : frame) p[0] = p[0] > 1.5 ? p[0] - 2.75 : p[0];
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_EQ(follower.state(), CoverState::kSolid);
  EXPECT_TRUE(std::isnan(follower.measure().value().solid_volume));
  EXPECT_TRUE(std::isnan(follower.measure().value().added()));
  for (Point& p : frame) p = {-p[0], p[1], 0.5 * p[0] + p[1]};
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_TRUE(std::isnan(follower.measure().value().solid_volume)) << "a flat frame";
  frame = example.rest();
  for (Point& p : frame) p[0] = -p[0];
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_NEAR(follower.measure().value().solid_volume, at_rest, 1e-12) << "a mirrored frame";
}

}  // namespace
}  // namespace medial_vk
