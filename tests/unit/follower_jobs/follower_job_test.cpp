// Balls that follow a mesh on the device: against the reference in every frame, and against the host's follower.
#include <volk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "device/context_impl.h"
#include "medial_vk/ball_union.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/motions.h"
#include "unit/follower_jobs/followed_on_device.h"

namespace medial_vk {
namespace {

double volume_of(std::span<const Ball> balls) { return measure_ball_union(balls).value().volume; }

TEST(FollowerJob, EveryBallOfEveryFrameIsInside) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  for (const Example& example : {torus(), l_shape()}) {
    for (const test::Motion motion : test::kMotions) {
      FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
      Follower host = example.follower({.steps = 0});
      for (const double time : {0.25, 0.5, 0.75, 1.0, 0.5, 0.0}) {
        const std::string where = std::string(test::name_of(motion)) + " " + std::to_string(time);
        const Frame frame = test::moved_vertices(example.rest(), motion, time);
        device.update(frame);
        device.expect_inside(frame, where);
        ASSERT_TRUE(host.update(frame).ok());
        EXPECT_LE(device.lost(), lost(host) + example.balls.size() / 50) << where;
        // Decisions between balls of nearly the same size differ, and ripples make many of them.
        EXPECT_GE(volume_of(device.balls()), 0.97 * volume_of(host.balls())) << where;
      }
    }
  }
}

TEST(FollowerJob, TheRestPoseGivesTheBallsOfTheHost) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = torus();
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  const Follower host = example.follower();
  const Frame moved = test::moved_vertices(example.rest(), test::Motion::kBend, 1);
  const double less = kLessOnDevice * lengths_of(example.rest());
  for (const bool again : {false, true}) {
    if (again) device.update(moved);
    device.update(example.rest());
    std::size_t same = 0;
    for (std::size_t i = 0; i < example.balls.size(); ++i) {
      const Ball &found = device.balls()[i], &expected = host.balls()[i];
      const double apart = length(found.centre - expected.centre);
      // Of vertices, contacts and directions in float.
      const double rounding = 4 * 0x1p-23 * lengths_of(example.rest());
      same += apart < 1e-5 && found.radius <= expected.radius + rounding + apart &&
                      found.radius >= expected.radius - less - rounding - apart
                  ? 1
                  : 0;
    }
    EXPECT_GE(same, example.balls.size() * 97 / 100) << again;  // others have contacts next to each other
    for (const FollowState state : {FollowState::kMedial, FollowState::kFlat, FollowState::kShrunk}) {
      const auto expected = static_cast<double>(std::ranges::count(host.states(), state));
      EXPECT_NEAR(static_cast<double>(device.count(state)), expected, 5);
    }
  }
}

TEST(FollowerJob, GivesTheSameAgain) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = l_shape();
  FollowedOnDevice one(test::quick_device(), example.mesh, example.balls),
      other(test::quick_device(), example.mesh, example.balls);
  const Frame first = test::moved_vertices(example.rest(), test::Motion::kTwist, 0.5),
              second = test::moved_vertices(example.rest(), test::Motion::kTwist, 1);
  one.update(first);
  other.update(first);
  EXPECT_EQ(greatest_difference(one.balls(), other.balls()), 0);
  const std::vector<Ball> after_first = one.balls();
  one.update(second);
  other.update(second);
  EXPECT_EQ(greatest_difference(one.balls(), other.balls()), 0);
  EXPECT_EQ(one.states(), other.states());
  one.job().reset();
  one.update(first);
  EXPECT_EQ(greatest_difference(one.balls(), after_first), 0);
  one.update(second);
  EXPECT_EQ(greatest_difference(one.balls(), other.balls()), 0);
}

// On devices with lanes in lockstep eight balls walk the tree together, elsewhere each by itself: all are inside, and
// nearly all are as large as the others.
TEST(FollowerJob, BallsThatWalkAloneAreAsLarge) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Context alone = test::make_context();
  if (!Internals::of(alone).has_lockstep_lanes) GTEST_SKIP() << "the device has no lanes in lockstep";
  Internals::of(alone).has_lockstep_lanes = false;
  for (const Example& example : {torus(), l_shape()}) {
    FollowedOnDevice one(alone, example.mesh, example.balls);
    FollowedOnDevice together(test::quick_device(), example.mesh, example.balls);
    const Frame frame = test::moved_vertices(example.rest(), test::Motion::kBend, 1);
    one.update(frame);
    together.update(frame);
    one.expect_inside(frame, "alone");
    // Both are the greatest balls but for this, where both have decided alike.
    const double less = kLessOnDevice * lengths_of(frame);
    std::size_t same = 0;
    for (std::size_t i = 0; i < example.balls.size(); ++i) {
      same += std::abs(one.balls()[i].radius - together.balls()[i].radius) <= less ? 1 : 0;
    }
    EXPECT_GE(same, example.balls.size() * 97 / 100);
  }
}

TEST(FollowerJob, StatesAreThoseOfTheOptions) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = torus();
  FollowerJobOptions options;
  options.object_angle = 4;  // above all
  options.shrunk = 0;
  FollowedOnDevice flat(test::quick_device(), example.mesh, example.balls, options);
  flat.update(example.rest());
  EXPECT_EQ(flat.count(FollowState::kFlat), example.balls.size());
  options = {1, 0, 1, 0};  // every ball is less than in double precision
  FollowedOnDevice shrunk(test::quick_device(), example.mesh, example.balls, options);
  shrunk.update(example.rest());
  EXPECT_EQ(shrunk.count(FollowState::kShrunk), example.balls.size());
  options = {0, 0, 1, 0};
  FollowedOnDevice medial(test::quick_device(), example.mesh, example.balls, options);
  medial.update(example.rest());
  EXPECT_EQ(medial.count(FollowState::kMedial), example.balls.size());
}

// The ball at the centre touches everywhere, so that a walk of the tree is too long for lavapipe.
TEST(FollowerJob, ABallThatTouchesEveryTriangleIsFollowed) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_sphere(1, 20'000)).value());
  const std::vector<Ball> balls = {{{0.001, 0, 0}, 0.99}, {{0, 0.5, 0}, 0.4}};
  FollowedOnDevice device(test::quick_device(), mesh, balls);
  Follower host = Follower::create(mesh, balls, {.steps = 0}).value();
  const Frame frame = {mesh.view().vertices.begin(), mesh.view().vertices.end()};
  for (const double factor : {1.0, 1.5, 1.0}) {
    Frame scaled = frame;
    for (Point& p : scaled) p = factor * p;
    device.update(scaled);
    device.expect_inside(scaled, "sphere");
    ASSERT_TRUE(host.update(scaled).ok());
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(device.balls()[i].radius, 0.999 * host.balls()[i].radius) << i;
  }
}

TEST(FollowerJob, PartsThatLieApartHaveTheirOwnRays) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh raw = test::make_turned_torus(40, 20);
  test::append(raw, test::moved(test::make_box({1, 1, 1}), {3, 0, 0}));
  const Example example(std::move(raw));
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  const Frame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, 0.5);
  device.update(frame);
  device.expect_inside(frame, "two parts");
  EXPECT_LE(device.lost(), 2u);
}

}  // namespace
}  // namespace medial_vk
