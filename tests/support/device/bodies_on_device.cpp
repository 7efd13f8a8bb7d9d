#include "support/device/bodies_on_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"
#include "medial_vk/device_bodies.h"

namespace medial_vk::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Beyond this share of M every verdict is proved: twice the error of the kernel, 22.1 * 2^-23 M, in which the growth
/// of balls that are rounded is included. The same and 2^-20 M, by which the kernel widens bounds, hold for these.
constexpr double kDecided = 2 * 22.1 * 0x1p-23, kWidth = kDecided + 0x1p-20;
/// The same of any size: far more than what the kernel adds for numbers that are flushed to 0, 2^-60.
constexpr double kLeast = 1e-17;

double separation_of_all(std::span<const Ball> a, std::span<const Ball> b, const Pose& pose) {
  double least = kInfinity;
  for (const Ball& of_b : b) {
    const Point centre = pose * of_b.centre;
    for (const Ball& of_a : a) least = std::min(least, length(of_a.centre - centre) - of_a.radius - of_b.radius);
  }
  return least;
}

void expect_verdict(Collision verdict, double cover, double inside, double decided) {
  if (verdict == Collision::kFree) {
    EXPECT_GT(cover, 0);
  } else if (verdict == Collision::kHit) {
    EXPECT_LE(inside, 0);
  } else {
    EXPECT_LE(cover, decided);
    EXPECT_GE(inside, -decided);
  }
}

/// Searches end at balls that overlap, so the named pair is only among those that are as close as `most`, or overlap.
void expect_pair(const BallPair& pair, std::span<const Ball> a, std::span<const Ball> b, const Pose& pose,
                 double most) {
  ASSERT_LT(pair.a, a.size());
  ASSERT_LT(pair.b, b.size());
  EXPECT_LE(separation_of_all(a.subspan(pair.a, 1), b.subspan(pair.b, 1), pose), std::max(0.0, most));
}

}  // namespace

Body body_of(const std::vector<Ball>& inside) {
  std::vector<Ball> cover = inside;
  for (Ball& ball : cover) ball.radius *= 1.5;
  return Body::create(inside, cover).value();
}

std::vector<Ball> balls_at_random(Random& random, std::size_t count, const Point& middle, double size) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({middle + point_in_cube(random, size), uniform(random, 0, 0.2 * size)});
  }
  return balls;
}

PosedBodies bodies_at_random(Random& random, double size) {
  PosedBodies of;
  of.size = 40 * size;
  for (const std::size_t count : {1, 8, 9, 65, 300}) {
    of.bodies.push_back(body_of(balls_at_random(random, count, point_in_cube(random, 2 * size), size)));
  }
  for (std::uint32_t i = 0; i < 500; ++i) {
    of.pairs.push_back({any_pose(random, point_in_cube(random, 3 * size)), i % 5, i / 5 % 5});
  }
  return of;
}

PosedBodies balls_that_almost_touch(Random& random, double size) {
  PosedBodies of;
  of.size = 8 * size;
  std::vector<Ball> balls;
  for (int i = 0; i < 20; ++i) {
    balls.push_back({point_in_cube(random, size), uniform(random, 0.1, 1) * size});
    of.bodies.push_back(Body::create({&balls.back(), 1}, {&balls.back(), 1}).value());
  }
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const Ball &a = balls[i % 20], &b = balls[i / 20 % 20];
    PosedPair pair = {any_pose(random, {0, 0, 0}), i % 20, i / 20 % 20};
    const Point away = point_in_cube(random, 1);
    const double gap = uniform(random, -1, 1) * std::pow(10, uniform(random, -9, -4)) * size;
    const Point to = a.centre + (a.radius + b.radius + gap) / length(away) * away;
    pair.pose.shift = to - pair.pose * b.centre;
    of.pairs.push_back(pair);
  }
  return of;
}

DeviceAnswers expect_answers(Context& context, const PosedBodies& of) {
  DeviceAnswers found;
  Result<DeviceBodies> there = DeviceBodies::create(context, of.bodies);
  EXPECT_TRUE(there.ok()) << there.error().message;
  if (!there.ok()) return found;
  found.verdicts.resize(of.pairs.size());
  found.bounds.resize(of.pairs.size());
  EXPECT_TRUE(there.value().collide_by_balls(of.pairs, found.verdicts).ok());
  EXPECT_TRUE(there.value().distance_bounds(of.pairs, found.bounds).ok());
  for (std::size_t i = 0; i < of.pairs.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const PosedPair& pair = of.pairs[i];
    const DistanceBounds& bounds = found.bounds[i];
    const Body &a = of.bodies[pair.a], &b = of.bodies[pair.b];
    const double cover = separation_of_all(a.cover(), b.cover(), pair.pose),
                 inside = separation_of_all(a.inside(), b.inside(), pair.pose);
    const double width = kWidth * of.size + kLeast;
    expect_verdict(found.verdicts[i], cover, inside, kDecided * of.size + kLeast);
    EXPECT_LE(bounds.lower, std::max(0.0, cover));
    EXPECT_GE(bounds.upper, std::max(0.0, inside));
    EXPECT_GE(bounds.lower, cover - width);
    EXPECT_LE(bounds.upper, std::max(0.0, inside) + width);
    expect_pair(bounds.cover_pair, a.cover(), b.cover(), pair.pose, cover + width);
    if (bounds.upper > 0) {
      expect_pair(bounds.inside_pair, a.inside(), b.inside(), pair.pose, inside + width);
    }
  }
  return found;
}

std::array<int, 3> count_verdicts(std::span<const Collision> verdicts) {
  std::array<int, 3> seen = {0, 0, 0};
  for (const Collision verdict : verdicts) ++seen[static_cast<std::size_t>(verdict)];
  return seen;
}

}  // namespace medial_vk::test
