// Balls that follow a mesh: certified in every frame by the reference, and invariant where the frame is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "following/greatest_ball.h"
#include "following/surface/moving_surface.h"
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

/// A rotation, then a shift; a third of a turn around a diagonal of the box, then a shift; a reflection in a plane.
Point turned(const Point& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {c * p[0] - s * p[1] + 3, s * p[0] + c * p[1] - 5, p[2] + 0.25};
}
Point turned_by_a_third(const Point& p) { return {p[1] + 3.1, p[2] - 5.7, p[0] + 0.3}; }
Point mirrored(const Point& p) { return {-p[0], p[1], p[2]}; }

using Placement = Point (*)(const Point&);

/// A bend, frame by frame.
std::vector<Frame> bend_of(const Example& example) {
  std::vector<Frame> frames;
  for (const double time : {0.3, 0.6, 1.0}) {
    frames.push_back(test::moved_vertices(example.rest(), test::Motion::kBend, time));
  }
  return frames;
}

std::vector<Frame> placed(std::vector<Frame> frames, Placement place) {
  for (Frame& frame : frames) std::ranges::transform(frame, frame.begin(), place);
  return frames;
}

/// By frame.
struct Followed {
  std::vector<std::vector<Ball>> balls;
  std::vector<std::vector<FollowState>> states;
  std::vector<double> volumes;  // of the solid
};
Followed followed(const Example& example, std::uint32_t steps, const std::vector<Frame>& frames) {
  Follower follower = example.follower({.steps = steps});
  Followed all;
  for (const Frame& frame : frames) {
    EXPECT_TRUE(follower.update(frame).ok());
    all.balls.push_back(copy_of(follower.balls()));
    all.states.emplace_back(follower.states().begin(), follower.states().end());
    all.volumes.push_back(follower.measure().value().solid_volume);
  }
  return all;
}

/// How much balls change where the coordinates do by what a placement rounds: by half of the last bit of a number below
/// 8, or by twice that.
double sensitivity(const Example& example, std::uint32_t steps, const std::vector<Frame>& frames) {
  const Followed plain = followed(example, steps, frames);
  std::mt19937_64 random(11);
  double greatest = 0;
  for (int trial = 0; trial < 4; ++trial) {
    std::vector<Frame> changed = frames;
    for (Frame& frame : changed) {
      for (Point& p : frame) {
        for (double& x : p) x += 0x1p-51 * static_cast<double>(random() % 5) - 0x1p-50;
      }
    }
    const Followed now = followed(example, steps, changed);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      greatest = std::max(greatest, greatest_difference(now.balls[i], plain.balls[i]));
    }
  }
  return greatest;
}

/// Frames that are images of others have balls that are images, exact to rounding: up to a small multiple of what
/// changes in the last bits of the vertices make.
void expect_balls_move_with(Placement place) {
  const Example example = torus();
  const std::vector<Frame> frames = bend_of(example);
  for (const std::uint32_t steps : {0u, 1u}) {
    const Followed plain = followed(example, steps, frames), moved = followed(example, steps, placed(frames, place));
    const double rounding = sensitivity(example, steps, frames);
    EXPECT_LT(rounding, 1e-10);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      std::vector<Ball> expected = plain.balls[i];
      for (Ball& ball : expected) ball.centre = place(ball.centre);
      EXPECT_LE(greatest_difference(moved.balls[i], expected), 8 * rounding) << i;
      // Vertices below 8 are rounded by less than 2^-50, which moves 60 units of area.
      EXPECT_NEAR(moved.volumes[i], plain.volumes[i], 60 * 0x1p-50);
    }
  }
}

TEST(Follower, BallsTurnWithTheFrame) { expect_balls_move_with(turned_by_a_third); }

// The longest side of the box is the same, so balls end the same slack before the surface.
TEST(Follower, BallsOfAMirroredFrameAreMirrored) { expect_balls_move_with(mirrored); }

// A turn by any angle changes the longest side of the box, of which the slack is a share: a ball ends a slack before
// the surface, or up to one more. At the object angle t, a slack at the second contact changes the radius by itself
// over 2 sin^2 t, and the centre as much.
TEST(Follower, MedialBallsTurnByAnyAngleUpToTheSlack) {
  const double least = std::sin(FollowerOptions().object_angle);
  const Example example = torus();
  const std::vector<Frame> frames = bend_of(example), images = placed(frames, turned);
  MovingSurface surface = MovingSurface::build(example.mesh).value();
  for (const std::uint32_t steps : {0u, 1u}) {
    const Followed plain = followed(example, steps, frames), moved = followed(example, steps, images);
    std::size_t medial = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      ASSERT_TRUE(surface.move(images[i], 1).ok());
      const double most = 2 * contact_slack(surface) / (2 * least * least);
      for (std::size_t k = 0; k < example.balls.size(); ++k) {
        if (plain.states[i][k] != FollowState::kMedial) continue;
        ++medial;
        const Ball expected = {turned(plain.balls[i][k].centre), plain.balls[i][k].radius};
        EXPECT_LE(greatest_difference({&moved.balls[i][k], 1}, {&expected, 1}), most) << i << " " << k;
      }
    }
    EXPECT_GT(medial, example.balls.size() / 4);
  }
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
