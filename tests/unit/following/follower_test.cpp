// Balls that follow a mesh: certified in every frame by the reference, and invariant where the frame is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "support/solids/motions.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

class FollowerInMotion : public testing::TestWithParam<std::tuple<test::Motion, std::uint32_t>> {};

TEST_P(FollowerInMotion, BallsAreInsideInEveryFrame) {
  const auto [motion, steps] = GetParam();
  for (const Example& example : {torus(), l_shape()}) {
    FollowerOptions options;
    options.steps = steps;
    Follower follower = example.follower(options);
    for (const double time : {0.25, 0.5, 0.75, 1.0}) {
      const Frame frame = test::moved_vertices(example.rest(), motion, time);
      ASSERT_TRUE(follower.update(frame).ok());
      expect_inside(follower, example.mesh, frame, std::string(test::name_of(motion)) + " " + std::to_string(time));
      EXPECT_EQ(lost(follower), 0u);
    }
  }
}

TEST_P(FollowerInMotion, ThereAndBackEndsAtTheRestPose) {
  const auto [motion, steps] = GetParam();
  const Example example = l_shape();
  FollowerOptions options;
  options.steps = steps;
  Follower follower = example.follower(options);
  const std::vector<Ball> rest = copy_of(follower.balls());
  for (const double time : {0.5, 1.0, 0.5, 0.0}) {
    ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), motion, time)).ok());
  }
  // A frame by formulas at time 0 differs from the rest pose by rounding.
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(All, FollowerInMotion,
                         testing::Combine(testing::ValuesIn(test::kMotions), testing::Values(0u, 1u)),
                         [](const auto& parameters) {
                           return std::string(test::name_of(std::get<0>(parameters.param))) +
                                  (std::get<1>(parameters.param) > 0 ? "_with_a_step" : "");
                         });

TEST(Follower, GivenBallsLieInThoseOfTheRestPose) {
  const Example example = l_shape();
  const Follower follower = example.follower();
  for (std::size_t i = 0; i < example.balls.size(); ++i) {
    const Ball &given = example.balls[i], &grown = follower.balls()[i];
    EXPECT_GE(grown.radius, length(grown.centre - given.centre) + given.radius - 1e-8) << i;
  }
  expect_inside(follower, example.mesh, example.rest(), "rest");
}

TEST(Follower, TheRestPoseAsAFrameChangesNothing) {
  const Example example = torus();
  Follower follower = example.follower();
  const std::vector<Ball> rest = copy_of(follower.balls());
  ASSERT_TRUE(follower.update(example.rest()).ok());
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-14);
}

/// A rotation, then a shift; or a reflection in a plane.
Point turned(const Point& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {c * p[0] - s * p[1] + 3, s * p[0] + c * p[1] - 5, p[2] + 0.25};
}
Point mirrored(const Point& p) { return {-p[0], p[1], p[2]}; }

/// Frames that are images of others have balls that are images, up to rounding and the contact slack.
void expect_balls_move_with(Point (*move)(const Point&), std::uint32_t steps) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = steps;
  Follower plain = example.follower(options), moved = example.follower(options);
  for (const double time : {0.3, 0.6, 1.0}) {
    const Frame frame = test::moved_vertices(example.rest(), test::Motion::kBend, time);
    Frame image = frame;
    std::ranges::transform(image, image.begin(), move);
    ASSERT_TRUE(plain.update(frame).ok());
    ASSERT_TRUE(moved.update(image).ok());
    std::vector<Ball> expected = copy_of(plain.balls());
    for (Ball& ball : expected) ball.centre = move(ball.centre);
    EXPECT_LE(greatest_difference(moved.balls(), expected), 1e-6) << time;
    EXPECT_NEAR(moved.measure().value().solid_volume, plain.measure().value().solid_volume, 1e-9);
    expect_inside(plain, example.mesh, frame, "plain");
  }
}

TEST(Follower, BallsTurnWithTheFrame) {
  for (const std::uint32_t steps : {0u, 1u}) expect_balls_move_with(turned, steps);
}

TEST(Follower, BallsOfAMirroredFrameAreMirrored) {
  for (const std::uint32_t steps : {0u, 1u}) expect_balls_move_with(mirrored, steps);
}

TEST(Follower, TheReferenceFindsBallsOfAMirroredFrameInside) {
  const Example example = torus();
  Follower follower = example.follower();
  Frame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, 1);
  std::ranges::transform(frame, frame.begin(), mirrored);
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_EQ(lost(follower), 0u);
  Mesh turned_over = example.mesh.prepared().mesh;
  turned_over.vertices = frame;
  test::turn_over(turned_over);
  for (const auto& line :
       reference::check_inside(test::to_reference(turned_over), test::to_reference(not_lost(follower))).lines) {
    EXPECT_EQ(line.failed, 0u) << line.first_failure;
  }
}

TEST(Follower, StatesAreThoseOfTheBalls) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.4}};
  const auto state = [&](FollowerOptions options, double height) {
    Follower follower = Follower::create(mesh, balls, options).value();
    Frame frame(mesh.view().vertices.begin(), mesh.view().vertices.end());
    for (Point& p : frame) p[2] *= height;
    EXPECT_TRUE(follower.update(frame).ok());
    return follower.states()[0];
  };
  FollowerOptions options;
  EXPECT_EQ(state(options, 1), FollowState::kMedial);
  EXPECT_EQ(state(options, 0.4), FollowState::kShrunk);
  EXPECT_EQ(state(options, 0), FollowState::kLost);
  options.shrunk = 0.1;
  EXPECT_EQ(state(options, 0.4), FollowState::kMedial);
  options.object_angle = 3;
  EXPECT_EQ(state(options, 0.4), FollowState::kFlat);
}

// A ball in a tube touches along a circle, and the second contact that is found may be a neighbour of the first, which
// says nothing about the medial axis. Steps must not leave it.
TEST(Follower, StepsDoNotLoseTheAxisOfATube) {
  Example tube(test::make_capsule(0.3, 3, 48), 0);
  const MeshReport& report = tube.mesh.prepared().report;
  const Point middle = 0.5 * (report.lower + report.upper), half = 0.5 * (report.upper - report.lower);
  const auto axis = static_cast<std::size_t>(std::max_element(half.begin(), half.end()) - half.begin());
  for (int i = 0; i < 24; ++i) {
    Point centre = middle;
    centre[axis] += (half[axis] - 0.32) * (i / 11.5 - 1);
    tube.balls.push_back({centre, 0.29});
  }
  FollowerOptions options;
  Follower without = tube.follower(options);
  options.steps = 1;
  Follower with = tube.follower(options);
  for (int i = 1; i <= 20; ++i) {
    Frame frame = tube.rest();
    for (Point& p : frame) {
      const double width = 1 + 0.03 * std::sin(0.15 * i) * std::sin(3 * p[axis]);
      for (std::size_t k = 0; k < 3; ++k) p[k] = k == axis ? p[k] : middle[k] + width * (p[k] - middle[k]);
    }
    ASSERT_TRUE(without.update(frame));
    ASSERT_TRUE(with.update(frame));
    EXPECT_GE(with.measure().value().ball_volume, 0.999 * without.measure().value().ball_volume) << i;
  }
}

TEST(Follower, ResultsDoNotDependOnThreads) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = 1;
  std::vector<std::vector<Ball>> results;
  for (const unsigned threads : {1u, 3u}) {
    options.threads = threads;
    Follower follower = example.follower(options);
    for (const double time : {0.5, 1.0}) {
      ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), test::Motion::kTwist, time)).ok());
    }
    results.push_back(copy_of(follower.balls()));
  }
  EXPECT_EQ(greatest_difference(results[0], results[1]), 0);
}

TEST(Follower, AfterAResetEarlierFramesDoNotMatter) {
  const Example example = l_shape();
  Follower seen = example.follower(), fresh = example.follower();
  ASSERT_TRUE(seen.update(test::moved_vertices(example.rest(), test::Motion::kRipple, 1)).ok());
  ASSERT_TRUE(seen.reset().ok());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
  const Frame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(seen.update(frame).ok());
  ASSERT_TRUE(fresh.update(frame).ok());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
}

TEST(Follower, MeasuresAreThoseOfTheFrame) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = 1;
  Follower follower = example.follower(options);
  const Frame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(follower.update(frame).ok());
  Mesh moved = example.mesh.prepared().mesh;
  moved.vertices = frame;
  const FollowMeasures measures = follower.measure().value();
  EXPECT_NEAR(measures.solid_volume, test::signed_volume(moved), 1e-9);
  EXPECT_EQ(measures.ball_volume, measure_ball_union(follower.balls()).value().volume);
  EXPECT_EQ(measures.outside_bound, 0);
  EXPECT_GT(measures.uncovered(), 0);
  // Steps towards a greater volume find one.
  Follower without = example.follower({.steps = 0});
  ASSERT_TRUE(without.update(frame).ok());
  EXPECT_GT(measures.ball_volume, without.measure().value().ball_volume);
}

}  // namespace
}  // namespace medial_vk
