// Verdicts and bounds for many poses on the device against all pairs of balls, in double and without a tree.
#include "medial_vk/device_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/collisions.h"
#include "support/device/bodies_on_device.h"
#include "support/device/device_test.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

using namespace test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class BodiesOnDevice : public DeviceTest {
 protected:
  void expect_proved_answers(const PosedBodies& of) {
    const std::array<int, 3> seen = count_verdicts(expect_answers(*context_, of).verdicts);
    for (std::size_t i = 0; i < 3; ++i) seen_[i] += seen[i];
  }
  /// `size` as in PosedBodies.
  void expect_proved_answers(std::span<const Body> bodies, std::span<const PosedPair> pairs, double size) {
    expect_proved_answers({{bodies.begin(), bodies.end()}, {pairs.begin(), pairs.end()}, size});
  }

  std::array<int, 3> seen_ = {0, 0, 0};
};

TEST_F(BodiesOnDevice, AnswerAsAllPairsDo) {
  Random random(21);
  for (const double size : {1e-6, 1.0, 1e6}) {
    SCOPED_TRACE(testing::Message() << "size " << size);
    expect_proved_answers(bodies_at_random(random, size));
  }
  for (const int times : seen_) EXPECT_GT(times, 20);
}

// One tree has four levels more than the other; one pose is far away.
TEST_F(BodiesOnDevice, OfFewBallsAndMany) {
  Random random(22);
  const Body bodies[] = {body_of(balls_at_random(random, 20000, {0, 0, 0}, 1)),
                         body_of(balls_at_random(random, 3, {0, 0, 0}, 0.1))};
  std::vector<PosedPair> pairs = {{any_pose(random, {1e6, -2e6, 0}), 0, 1}};
  expect_proved_answers(bodies, pairs, 4e6);
  pairs.clear();
  for (std::uint32_t i = 0; i < 24; ++i)
    pairs.push_back({any_pose(random, point_in_cube(random, 2)), i % 2, 1 - i % 2});
  expect_proved_answers(bodies, pairs, 40);
  EXPECT_GT(seen_[0], 0);
  EXPECT_GT(seen_[1], 0);
}

TEST_F(BodiesOnDevice, OfBallsThatAlmostTouch) {
  Random random(25);
  for (const double size : {1e-6, 1.0, 1e6}) {
    SCOPED_TRACE(testing::Message() << "size " << size);
    expect_proved_answers(balls_that_almost_touch(random, size));
  }
  for (const int times : seen_) EXPECT_GT(times, 20);
}

// Around the balls of one body lie small balls of the other one in all directions, at nearly the same distance: balls
// around groups of them overlap the former, so that no group is passed over. A search takes too many steps for
// lavapipe.
TEST_F(BodiesOnDevice, TheHostCompletesSearchesThatAreTooLong) {
  Random random(24);
  std::vector<Ball> shell, middle;
  while (shell.size() < 30'000) {
    const Point p = point_in_cube(random, 1);
    const double length_of_p = length(p);
    if (length_of_p > 0.1 && length_of_p < 1) shell.push_back({1 / length_of_p * p, 0.002});
  }
  for (int i = 0; i < 9; ++i) middle.push_back({{1e-3 * i, 0, 0}, 0.98});
  const Body bodies[] = {Body::create(shell, shell).value(), Body::create(middle, middle).value()};
  const PosedPair pairs[] = {{Pose(), 0, 1}, {make_pose({0, 1e-3, 0}, {1, 2, 3}), 1, 0}};
  expect_proved_answers(bodies, pairs, 10);
  EXPECT_EQ(seen_[static_cast<std::size_t>(Collision::kFree)], 2);
}

TEST_F(BodiesOnDevice, WithoutASetAreUndecided) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}};
  const Body bodies[] = {Body::create(balls, {}).value(), Body::create({}, balls).value()};
  const Pose here = make_pose({0, 0, 0}, {0, 0, 0}), there = make_pose({9, 0, 0}, {0, 0, 0});
  const PosedPair pairs[] = {{here, 0, 0}, {there, 0, 0}, {here, 1, 1}, {there, 1, 1}, {here, 1, 0}, {there, 0, 1}};
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value();
  std::vector<Collision> verdicts(6);
  ASSERT_TRUE(on_device.collide_by_balls(pairs, verdicts).ok());
  constexpr Collision kNothing = Collision::kUndecided;
  EXPECT_EQ(verdicts, (std::vector{Collision::kHit, kNothing, kNothing, Collision::kFree, kNothing, kNothing}));
  std::vector<DistanceBounds> bounds(6);
  ASSERT_TRUE(on_device.distance_bounds(pairs, bounds).ok());
  EXPECT_NEAR(bounds[1].upper, 7, 1e-4);
  EXPECT_EQ(bounds[1].lower, 0);
  EXPECT_NEAR(bounds[3].lower, 7, 1e-4);
  EXPECT_EQ(bounds[3].upper, kInfinity);
  EXPECT_EQ(bounds[5].lower, 0);
  EXPECT_EQ(bounds[5].upper, kInfinity);
  EXPECT_EQ(bounds[5].cover_pair, BallPair());
}

// Poses beyond the range of the kernel are the host's; equal, touching and distant balls.
TEST_F(BodiesOnDevice, AnswerAsTheHostAtTheEnds) {
  const Body bodies[] = {body_of({{{0, 0, 0}, 1}}), body_of({{{1e18 - 2e17, 0, 0}, 1e17}}), body_of({{{5, 5, 5}, 0}})};
  std::vector<PosedPair> pairs;
  for (std::uint32_t i = 0; i < 9; ++i) {
    for (const double x : {0.0, 2.0, 1e9, -9e17, 1e19, std::numeric_limits<double>::quiet_NaN()}) {
      pairs.push_back({make_pose({0, 0, 0}, {0.1, 0.2, 0.3}), i % 3, i / 3});
      pairs.back().pose.shift = {x, 0, 0};
    }
  }
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value();
  std::vector<Collision> found(pairs.size()), expected(pairs.size());
  std::vector<DistanceBounds> bounds(pairs.size()), of_host(pairs.size());
  ASSERT_TRUE(on_device.collide_by_balls(pairs, found).ok());
  ASSERT_TRUE(on_device.distance_bounds(pairs, bounds).ok());
  collide_by_balls(bodies, pairs, expected);
  distance_bounds(bodies, pairs, of_host);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "pair " << i);
    EXPECT_TRUE(found[i] == expected[i] || found[i] == Collision::kUndecided);
    EXPECT_LE(bounds[i].lower, of_host[i].upper);
    EXPECT_GE(bounds[i].upper, of_host[i].lower);
  }
}

// In range for the host alone, whose answers are returned.
TEST_F(BodiesOnDevice, AnswerAsTheHostWhereFloatsEnd) {
  std::vector<Ball> corners;
  for (const double x : {-0.99e18, 0.99e18}) corners.push_back({{x, x, x}, 1e15});
  const Body bodies[] = {body_of(corners)};
  const PosedPair pairs[] = {{make_pose({5.9e18, 0, 0}, {0, 0, 0}), 0, 0}};
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value();
  Collision found = Collision::kUndecided;
  DistanceBounds bounds, of_host;
  ASSERT_TRUE(on_device.collide_by_balls(pairs, {&found, 1}).ok());
  ASSERT_TRUE(on_device.distance_bounds(pairs, {&bounds, 1}).ok());
  distance_bounds(bodies, pairs, {&of_host, 1});
  EXPECT_EQ(found, Collision::kFree);
  EXPECT_EQ(bounds.lower, of_host.lower);
  EXPECT_EQ(bounds.upper, of_host.upper);
}

/// Some pairs of bodies whose middles are 0 or 9 apart.
std::vector<PosedPair> near_and_far(std::size_t count, std::size_t step) {
  const PosedPair far = {make_pose({9, 0, 0}, {0, 0, 0}), 0, 0}, near = {make_pose({0, 0, 0}, {0, 0, 0}), 0, 0};
  std::vector<PosedPair> pairs(count, far);
  for (std::size_t i = 0; i < count; i += step) pairs[i] = near;
  return pairs;
}

TEST_F(BodiesOnDevice, AnyNumberOfPairs) {
  Random random(23);
  const Body bodies[] = {body_of(balls_at_random(random, 5, {0, 0, 0}, 1))};
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value();
  EXPECT_TRUE(on_device.collide_by_balls({}, {}).ok());
  const std::size_t count = 2 * (1u << 18) + 5, step = 100'003;  // more than two blocks
  for (const std::size_t some : {std::size_t{3}, count, std::size_t{2000}}) {
    std::vector<Collision> verdicts(some, Collision::kUndecided);
    ASSERT_TRUE(on_device.collide_by_balls(near_and_far(some, step), verdicts).ok());
    for (std::size_t i = 0; i < some; ++i) {
      ASSERT_EQ(verdicts[i], i % step == 0 ? Collision::kHit : Collision::kFree) << i;
    }
  }
}

TEST_F(BodiesOnDevice, RefuseWhatIsWrong) {
  EXPECT_EQ(DeviceBodies::create(*context_, {}).error().code, ErrorCode::kUsage);
  const Body bodies[] = {body_of({{{0, 0, 0}, 1}})};
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value();
  const PosedPair pairs[] = {{Pose(), 0, 0}, {Pose(), 0, 1}};
  std::vector<Collision> verdicts(2);
  const Status status = on_device.collide_by_balls(pairs, verdicts);
  EXPECT_EQ(status.error().code, ErrorCode::kUsage);
  EXPECT_NE(status.error().message.find("pair 1"), std::string::npos) << status.error().message;
  EXPECT_EQ(on_device.collide_by_balls({pairs, 1}, verdicts).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
