// Verdicts for many poses against all pairs of balls, in double and without a tree.
#include "medial_vk/collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

using namespace test;

/// The least separation of all pairs, negative if some overlap.
double separation_of_all(std::span<const Ball> a, std::span<const Ball> b, const Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& of_b : b) {
    const Point centre = pose * of_b.centre;
    for (const Ball& of_a : a) least = std::min(least, length(of_a.centre - centre) - of_a.radius - of_b.radius);
  }
  return least;
}

std::vector<Ball> balls_at_random(Random& random, std::size_t count, const Point& middle, double size) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({middle + point_in_cube(random, size), uniform(random, 0, 0.2 * size)});
  }
  return balls;
}

/// Beyond this share of M every verdict is proved: 3 E = 54 * 2^-24 M of tree_search.h, and less than 8 * 2^-24 M by
/// which two balls grow when they are rounded.
constexpr double kDecided = 62 * 0x1p-24;

/// `size` is at least M, the sum of the distance of the bodies' middles and of their reaches. Counts each verdict.
void expect_verdicts(const Body& a, const Body& b, std::span<const Pose> poses, double size, std::array<int, 3>& seen) {
  std::vector<Collision> verdicts(poses.size(), Collision::kUndecided);
  collide_by_balls(a, b, poses, verdicts, {1});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double cover = separation_of_all(a.cover(), b.cover(), poses[i]),
                 inside = separation_of_all(a.inside(), b.inside(), poses[i]);
    ++seen[static_cast<std::size_t>(verdicts[i])];
    SCOPED_TRACE(testing::Message() << "pose " << i);
    if (verdicts[i] == Collision::kFree) {
      EXPECT_GT(cover, 0);
    } else if (verdicts[i] == Collision::kHit) {
      EXPECT_LE(inside, 0);
    } else {
      EXPECT_LE(cover, kDecided * size);
      EXPECT_GE(inside, -kDecided * size);
    }
  }
}

TEST(Collisions, AreThoseOfAllPairs) {
  Random random(11);
  std::array<int, 3> seen = {0, 0, 0};
  for (const std::size_t count : {1, 8, 9, 65, 300}) {
    for (const double size : {1e-6, 1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << count << " balls of size " << size);
      const Point middle_a = point_in_cube(random, 2 * size), middle_b = point_in_cube(random, 2 * size);
      const std::vector<Ball> of_a = balls_at_random(random, count, middle_a, size),
                              of_b = balls_at_random(random, count / 9 + 1, middle_b, size);
      std::vector<Ball> around_a = of_a, around_b = of_b;
      for (std::vector<Ball>* balls : {&around_a, &around_b}) {
        for (Ball& ball : *balls) ball.radius *= 1.5;
      }
      const Body a = Body::create(of_a, around_a).value(), b = Body::create(of_b, around_b).value();
      std::vector<Pose> poses;
      for (int i = 0; i < 60; ++i) poses.push_back(any_pose(random, point_in_cube(random, 3 * size)));
      expect_verdicts(a, b, poses, 40 * size, seen);
      expect_verdicts(b, a, poses, 40 * size, seen);
    }
  }
  for (const int times : seen) EXPECT_GT(times, 20);
}

// One tree has five levels more than the other; one pose is far away.
TEST(Collisions, OfFewBallsAndMany) {
  Random random(12);
  std::array<int, 3> seen = {0, 0, 0};
  const std::vector<Ball> many = balls_at_random(random, 20000, {0, 0, 0}, 1),
                          few = balls_at_random(random, 3, {0, 0, 0}, 0.1);
  const Body a = Body::create(many, many).value(), b = Body::create(few, few).value();
  std::vector<Pose> poses = {any_pose(random, {1e6, -2e6, 0})};
  for (int i = 0; i < 10; ++i) poses.push_back(any_pose(random, point_in_cube(random, 2)));
  expect_verdicts(a, b, poses, 4e6, seen);
  expect_verdicts(b, a, poses, 4e6, seen);
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

// Balls at known gaps about zero: a pose within rounding is undecided, others are proved.
TEST(Collisions, OfBallsThatAlmostTouch) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}};
  const Body body = Body::create(balls, balls).value();
  const auto verdict = [&](double x) {
    const Pose pose = make_pose({x, 0, 0}, {0.1, 0.2, 0.3});
    Collision found = Collision::kUndecided;
    collide_by_balls(body, body, {&pose, 1}, {&found, 1});
    return found;
  };
  EXPECT_EQ(verdict(2), Collision::kUndecided);
  EXPECT_EQ(verdict(2 + 4 * kDecided), Collision::kFree);
  EXPECT_EQ(verdict(2 - 4 * kDecided), Collision::kHit);
  EXPECT_EQ(verdict(0), Collision::kHit);
  EXPECT_EQ(verdict(1e12), Collision::kFree);
  EXPECT_EQ(verdict(1e19), Collision::kUndecided);
}

TEST(Collisions, WithoutASetAreUndecided) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}};
  const Body inside = Body::create(balls, {}).value(), cover = Body::create({}, balls).value();
  const std::vector<Pose> poses = {make_pose({0, 0, 0}, {0, 0, 0}), make_pose({9, 0, 0}, {0, 0, 0})};
  std::vector<Collision> verdicts(2);
  collide_by_balls(inside, inside, poses, verdicts);
  EXPECT_EQ(verdicts, (std::vector{Collision::kHit, Collision::kUndecided}));
  collide_by_balls(cover, cover, poses, verdicts);
  EXPECT_EQ(verdicts, (std::vector{Collision::kUndecided, Collision::kFree}));
  collide_by_balls(cover, inside, poses, verdicts);
  EXPECT_EQ(verdicts, (std::vector{Collision::kUndecided, Collision::kUndecided}));
  collide_by_balls(cover, inside, {}, {});
}

TEST(Collisions, DoNotDependOnThreads) {
  Random random(13);
  const std::vector<Ball> balls = balls_at_random(random, 200, {0, 0, 0}, 1);
  const Body body = Body::create(balls, balls).value();
  std::vector<Pose> poses;
  for (int i = 0; i < 2000; ++i) poses.push_back(any_pose(random, point_in_cube(random, 3)));
  std::vector<Collision> one(poses.size()), four(poses.size());
  collide_by_balls(body, body, poses, one, {1});
  collide_by_balls(body, body, poses, four, {4});
  EXPECT_EQ(one, four);
}

}  // namespace
}  // namespace medial_vk
