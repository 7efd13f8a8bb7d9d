// Bounds of distances against all pairs of balls, in double and without a tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/proximity.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

using namespace test;

/// The least separation of all pairs; 0 if some overlap.
double least_separation(std::span<const Ball> a, std::span<const Ball> b, const Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& of_b : b) {
    const Point centre = pose * of_b.centre;
    for (const Ball& of_a : a) {
      least = std::min(least, length(of_a.centre - centre) - of_a.radius - of_b.radius);
    }
  }
  return std::max(0.0, least);
}

double separation_of(const BallPair& pair, std::span<const Ball> a, std::span<const Ball> b, const Pose& pose) {
  return length(a[pair.a].centre - pose * b[pair.b].centre) - a[pair.a].radius - b[pair.b].radius;
}

std::vector<Ball> cloud(Random& random, std::size_t count, const Point& middle, double size) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({middle + point_in_cube(random, size), uniform(random, 0, 0.2 * size)});
  }
  return balls;
}

/// A bound is this share of M at most away from the distance of the sets: 2 E = 36 * 2^-24 M of closest_balls.h, and
/// less than 8 * 2^-24 M by which two balls grow when they are rounded.
constexpr double kAccuracy = 44 * 0x1p-24;

/// `size` is at least M, the sum of the distance of the bodies' centres and of their reaches.
void expect_bounds(const DistanceBounds& bounds, const Body& a, const Body& b, const Pose& pose, double size) {
  const double cover = least_separation(a.cover(), b.cover(), pose),
               inside = least_separation(a.inside(), b.inside(), pose);
  EXPECT_LE(bounds.lower, cover);
  EXPECT_GE(bounds.lower, cover - kAccuracy * size);
  EXPECT_GE(bounds.upper, inside);
  EXPECT_LE(bounds.upper, inside + kAccuracy * size);
  if (inside > 0) {
    EXPECT_LE(separation_of(bounds.inside_pair, a.inside(), b.inside(), pose), bounds.upper);
  }
}

Body body(const std::vector<Ball>& inside, const std::vector<Ball>& cover) {
  return Body::create(inside, cover).value();
}

TEST(DistanceBounds, OfCloudsAreThoseOfAllPairs) {
  Random random(1);
  for (const std::size_t count : {1, 2, 7, 8, 9, 63, 64, 65, 100, 600}) {
    for (const double size : {1e-12, 1.0, 1e12}) {
      const Point middle_a = point_in_cube(random, 3 * size), middle_b = point_in_cube(random, 3 * size);
      const Body a = body(cloud(random, count, middle_a, size), cloud(random, count + 3, middle_a, size));
      const Body b = body(cloud(random, count, middle_b, size), cloud(random, count / 9 + 1, middle_b, size));
      for (int i = 0; i < 10; ++i) {
        const Pose pose = any_pose(random, point_in_cube(random, 4 * size));
        SCOPED_TRACE(testing::Message() << count << " balls of size " << size << ", pose " << i);
        expect_bounds(distance_bounds(a, b, pose), a, b, pose, 40 * size);
      }
    }
  }
}

// One tree has five levels more than the other.
TEST(DistanceBounds, OfFewBallsAndMany) {
  Random random(5);
  const std::vector<Ball> many = cloud(random, 40000, {0, 0, 0}, 1), few = cloud(random, 3, {0, 0, 0}, 0.1);
  const Body a = body(many, many), b = body(few, few);
  for (int i = 0; i < 5; ++i) {
    const Pose pose = any_pose(random, point_in_cube(random, 3));
    expect_bounds(distance_bounds(a, b, pose), a, b, pose, 12);
    expect_bounds(distance_bounds(b, a, pose), b, a, pose, 12);
  }
}

TEST(DistanceBounds, ANearbyStartChangesNothing) {
  Random random(2);
  const Body a = body(cloud(random, 300, {0, 0, 0}, 1), cloud(random, 200, {0, 0, 0}, 1));
  const Body b = body(cloud(random, 250, {0, 0, 0}, 1), cloud(random, 400, {0, 0, 0}, 1));
  DistanceBounds last;
  for (int i = 0; i < 300; ++i) {
    const Pose pose = make_pose({3 - 0.01 * i, 0.1, 0.2}, {0.02 * i, 0.3, 0.01 * i});
    last = distance_bounds(a, b, pose, last);
    expect_bounds(last, a, b, pose, 10);
    const DistanceBounds fresh = distance_bounds(a, b, pose);
    EXPECT_NEAR(last.lower, fresh.lower, 10 * kAccuracy);
    EXPECT_NEAR(last.upper, fresh.upper, 10 * kAccuracy);
  }
}

/// Balls that are far from the closest ones leave many pairs of nodes at first.
TEST(DistanceBounds, AStartOfAnUnrelatedPoseChangesNothing) {
  Random random(22);
  for (const std::size_t count : {40, 500, 3000}) {
    const std::vector<Ball> balls = cloud(random, count, {0, 0, 0}, 1);
    const Body a = body(balls, cloud(random, count, {0, 0, 0}, 1)), b = body(balls, balls);
    DistanceBounds last;
    for (int i = 0; i < 30; ++i) {
      const Pose pose = any_pose(random, point_in_cube(random, 4));
      last = distance_bounds(a, b, pose, last);
      expect_bounds(last, a, b, pose, 12);
    }
  }
}

TEST(DistanceBounds, AStartOfOtherBodiesIsIgnored) {
  const Body a = body({{{0, 0, 0}, 1}}, {{{0, 0, 0}, 1}}), b = body({{{0, 0, 0}, 2}}, {{{0, 0, 0}, 2}});
  DistanceBounds start;
  start.cover_pair = {17, 0};
  start.inside_pair = {0, 99};
  const DistanceBounds bounds = distance_bounds(a, b, make_pose({10, 0, 0}, {0, 0, 0}), start);
  EXPECT_EQ(bounds.inside_pair, (BallPair{0, 0}));
  EXPECT_EQ(bounds.cover_pair, (BallPair{0, 0}));
  EXPECT_NEAR(bounds.upper, 7, 1e-5);
}

TEST(DistanceBounds, DecideCollisionsBySets) {
  const Body a = body({{{0, 0, 0}, 1}}, {{{0, 0, 0}, 1.1}}), b = body({{{0, 0, 0}, 1}}, {{{0, 0, 0}, 1.1}});
  const auto collision = [&](double x) {
    return distance_bounds(a, b, make_pose({x, 0, 0}, {0.1, 0.2, 0.3})).collision();
  };
  EXPECT_EQ(collision(2.21), Collision::kFree);
  EXPECT_EQ(collision(2.19), Collision::kUndecided);
  EXPECT_EQ(collision(2.01), Collision::kUndecided);
  EXPECT_EQ(collision(1.99), Collision::kHit);
  EXPECT_EQ(collision(0), Collision::kHit);
}

TEST(DistanceBounds, ABallInsideAnotherHasDistanceZero) {
  const Body large = body({{{0, 0, 0}, 100}}, {{{0, 0, 0}, 101}}), small = body({{{0, 0, 0}, 1}}, {{{0, 0, 0}, 2}});
  const DistanceBounds bounds = distance_bounds(large, small, make_pose({3, 4, 5}, {0, 0, 0}));
  EXPECT_EQ(bounds.lower, 0);
  EXPECT_EQ(bounds.upper, 0);
}

TEST(DistanceBounds, WithoutASetThereIsNoBoundOfItsKind) {
  const Body inside_only = body({{{0, 0, 0}, 1}}, {}), cover_only = body({}, {{{0, 0, 0}, 1}});
  const Pose pose = make_pose({5, 0, 0}, {0, 0, 0});
  EXPECT_EQ(distance_bounds(inside_only, inside_only, pose).lower, 0);
  EXPECT_NEAR(distance_bounds(inside_only, inside_only, pose).upper, 3, 1e-5);
  EXPECT_NEAR(distance_bounds(cover_only, cover_only, pose).lower, 3, 1e-5);
  EXPECT_EQ(distance_bounds(cover_only, cover_only, pose).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(distance_bounds(inside_only, cover_only, pose).inside_pair, BallPair{});
}

// Of two bodies that are equal, and of bodies far from the origins of their frames and from each other.
TEST(DistanceBounds, OfEqualAndDistantBodies) {
  Random random(3);
  const std::vector<Ball> balls = cloud(random, 500, {1e6, -1e6, 2e6}, 1);
  const Body a = body(balls, balls), b = body(balls, balls);
  EXPECT_EQ(distance_bounds(a, b, Pose{}).collision(), Collision::kHit);
  for (const double far : {1.0, 1e3, 1e6, 1e9}) {
    const Pose pose = any_pose(random, point_in_cube(random, far));
    expect_bounds(distance_bounds(a, b, pose), a, b, pose, 4 * far + 1.5e7);
  }
}

TEST(DistanceBounds, OfEqualBallsAndPoints) {
  const std::vector<Ball> same(100, Ball{{1, 2, 3}, 0.5}), points(40, Ball{{0, 0, 0}, 0});
  const Body a = body(same, same), b = body(points, points);
  const Pose pose = make_pose({4, 6, 3}, {1, 2, 3});
  expect_bounds(distance_bounds(a, b, pose), a, b, pose, 20);
  EXPECT_EQ(distance_bounds(b, b, Pose{}).collision(), Collision::kHit);
}

// A ball around equal balls must not be closer to others than they are: every pair of them would be compared.
TEST(DistanceBounds, OfHundredThousandEqualBallsTakeNoTime) {
  const std::vector<Ball> same(100000, Ball{{1, 2, 3}, 0.1});
  const Body a = body(same, same);
  const Pose pose = make_pose({5, 0.3, 0.1}, {0.5, 0.6, 0.7});
  const DistanceBounds bounds = distance_bounds(a, a, pose);
  const double exact = length(Point{1, 2, 3} - pose * Point{1, 2, 3}) - 0.2;
  EXPECT_LE(bounds.lower, exact);
  EXPECT_GE(bounds.upper, exact);
  EXPECT_NEAR(bounds.lower, bounds.upper, 20 * kAccuracy);
}

TEST(DistanceBounds, OfTheLargestBallsAndShifts) {
  const std::vector<Ball> largest = {{{9e17, -9e17, 9e17}, 1e17}, {{-9e17, 9e17, -9e17}, 1e17}};
  const Body a = body(largest, largest), b = body({{{0, 0, 0}, 1}}, {{{0, 0, 0}, 1}});
  Random random(6);
  for (const Pose& pose : {any_pose(random, {1e18, -1e18, 1e18}), any_pose(random, {0, 0, 1}), Pose{}}) {
    expect_bounds(distance_bounds(a, a, pose), a, a, pose, 1e19);
    expect_bounds(distance_bounds(a, b, pose), a, b, pose, 1e19);
  }
  // Centres that are farther apart than any two bodies whose frames agree.
  const Body corner = body({{{9e17, 9e17, 9e17}, 1e17}}, {{{9e17, 9e17, 9e17}, 1e17}});
  const Pose opposite = {{{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}, {-1e18, -1e18, -1e18}};
  expect_bounds(distance_bounds(corner, corner, opposite), corner, corner, opposite, 1e19);
  for (const double beyond : {1e20, 1e60, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const DistanceBounds bounds = distance_bounds(b, b, make_pose({beyond, 0, 0}, {1, 2, 3}));
    EXPECT_EQ(bounds.lower, 0);
    EXPECT_EQ(bounds.upper, std::numeric_limits<double>::infinity());
  }
}

// Their squared distance is no double.
TEST(DistanceBounds, OfPointsThatHardlyDiffer) {
  const Body a = body({{{0, 0, 0}, 0}}, {{{0, 0, 0}, 0}}), b = body({{{1e-170, 0, 0}, 0}}, {{{1e-170, 0, 0}, 0}});
  EXPECT_EQ(distance_bounds(a, b, Pose{}).collision(), Collision::kUndecided);
  EXPECT_EQ(distance_bounds(a, a, Pose{}).collision(), Collision::kHit);
}

TEST(DistanceBounds, OfManyPosesAreThoseOfEachOnAnyNumberOfThreads) {
  Random random(4);
  const Body a = body(cloud(random, 100, {0, 0, 0}, 1), cloud(random, 90, {0, 0, 0}, 1));
  std::vector<Pose> poses;
  for (int i = 0; i < 1000; ++i) poses.push_back(any_pose(random, point_in_cube(random, 3)));
  std::vector<DistanceBounds> one(poses.size()), four(poses.size());
  distance_bounds(a, a, poses, one, {.threads = 1});
  distance_bounds(a, a, poses, four, {.threads = 4});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(one[i].lower, four[i].lower);
    EXPECT_EQ(one[i].upper, four[i].upper);
    expect_bounds(one[i], a, a, poses[i], 12);
  }
}

TEST(Body, RefusesBallsThatAreNone) {
  const std::vector<Ball> good = {{{0, 0, 0}, 1}};
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Body::create({}, {}).error().code, ErrorCode::kUsage);
  for (const Ball& bad : {Ball{{0, 0, 0}, -1}, Ball{{infinite, 0, 0}, 1}, Ball{{0, 0, 0}, std::nan("")},
                          Ball{{0, std::nan(""), 0}, 1}, Ball{{0, 0, 9e17}, 2e17}}) {
    const std::vector<Ball> balls = {good[0], bad};
    const Result<Body> inside = Body::create(balls, good), cover = Body::create(good, balls);
    ASSERT_FALSE(inside.ok() || cover.ok());
    EXPECT_THAT(inside.error().message, testing::HasSubstr("ball 1 of `inside`"));
    EXPECT_THAT(cover.error().message, testing::HasSubstr("ball 1 of `cover`"));
  }
}

}  // namespace
}  // namespace medial_vk
