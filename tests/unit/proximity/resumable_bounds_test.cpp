// Bounds within a budget: they only narrow, hold at any stop, and end at those of the whole search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/resumable_bounds.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

using namespace test;

std::vector<Ball> some_balls(Random& random, std::size_t count, const Point& middle, double size) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({middle + point_in_cube(random, size), uniform(random, 0, 0.2 * size)});
  }
  return balls;
}

double separation_of_sets(std::span<const Ball> a, std::span<const Ball> b, const Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& q : b) {
    const Point centre = pose * q.centre;
    for (const Ball& p : a) least = std::min(least, length(p.centre - centre) - p.radius - q.radius);
  }
  return std::max(0.0, least);
}

/// The error of placed_balls.h, 2^-46 S, twice, and the stretch of the rotation.
constexpr double kError = 2 * 0x1p-46 + 1e-11;

TEST(ResumableBounds, NarrowUntilTheyAreThoseOfTheSets) {
  Random random(1);
  for (const std::size_t count : {1, 3, 9, 100, 500}) {
    for (const double size : {1e-6, 1.0, 1e6}) {
      const Point middle_a = point_in_cube(random, 2 * size), middle_b = point_in_cube(random, 2 * size);
      // Not the balls of one solid: the distances of the two pairs of sets are in no order, and so apart from one
      // another.
      const Body a =
          Body::create(some_balls(random, count, middle_a, size), some_balls(random, 2 * count, middle_a, size))
              .value();
      const Body b =
          Body::create(some_balls(random, count, middle_b, size), some_balls(random, count, middle_b, size)).value();
      for (int i = 0; i < 4; ++i) {
        const Pose pose = any_pose(random, point_in_cube(random, 5 * size));
        const double lower = separation_of_sets(a.cover(), b.cover(), pose),
                     upper = separation_of_sets(a.inside(), b.inside(), pose), error = kError * 40 * size;
        ResumableBounds search = ResumableBounds::create(a, b, pose).value();
        SCOPED_TRACE(testing::Message() << count << " balls of size " << size << ", pose " << i);
        std::size_t runs = 0;
        for (DistanceBounds before; !search.is_complete(); ++runs) {
          ASSERT_LT(runs, 100000u);
          const DistanceBounds& now = search.bounds();
          EXPECT_TRUE(now.lower >= before.lower && now.upper <= before.upper);
          EXPECT_LE(now.lower, lower);
          EXPECT_GE(now.upper, upper);
          EXPECT_TRUE(std::isfinite(now.upper));
          before = now;
          EXPECT_TRUE(search.run(1 + runs % 3).ok());
        }
        EXPECT_LE(search.bounds().lower, lower);
        if (upper > 0) {
          EXPECT_GE(search.bounds().lower, lower - error);
        }
        EXPECT_GE(search.bounds().upper, upper);
        EXPECT_LE(search.bounds().upper, upper + error);
        const DistanceBounds last = search.bounds();
        EXPECT_TRUE(search.run(1000).ok());
        EXPECT_EQ(search.bounds().lower, last.lower);
        EXPECT_EQ(search.bounds().upper, last.upper);
      }
    }
  }
}

TEST(ResumableBounds, WithinOneCallAreThoseOfManyCalls) {
  Random random(2);
  const Body a = Body::create(some_balls(random, 300, {0, 0, 0}, 1), some_balls(random, 300, {0, 0, 0}, 1)).value();
  const Pose pose = any_pose(random, {2.5, 0.5, 0});
  ResumableBounds one = ResumableBounds::create(a, a, pose).value(), many = ResumableBounds::create(a, a, pose).value();
  EXPECT_TRUE(one.run(8).ok());
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(many.run(2).ok());
  EXPECT_EQ(one.bounds().lower, many.bounds().lower);
  EXPECT_EQ(one.bounds().upper, many.bounds().upper);
}

TEST(ResumableBounds, OfBodiesWithOneSetAndOfShiftsBeyond) {
  const std::vector<Ball> unit = {{{0, 0, 0}, 1}};
  const Body inside = Body::create(unit, {}).value(), cover = Body::create({}, unit).value();
  const auto complete = [](const Body& body, double x) {
    ResumableBounds search = ResumableBounds::create(body, body, make_pose({x, 0, 0}, {0, 0, 0})).value();
    EXPECT_TRUE(search.run(100).ok());
    EXPECT_TRUE(search.is_complete());
    return search.bounds();
  };
  EXPECT_NEAR(complete(inside, 5).upper, 3, 1e-9);
  EXPECT_EQ(complete(inside, 5).lower, 0);
  EXPECT_EQ(complete(inside, 5).inside_pair, (BallPair{0, 0}));
  EXPECT_EQ(complete(inside, 1).upper, 0);
  EXPECT_NEAR(complete(cover, 5).lower, 3, 1e-9);
  EXPECT_EQ(complete(cover, 5).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(complete(cover, 1).lower, 0);
  EXPECT_EQ(complete(inside, 1e20).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(complete(cover, std::nan("")).lower, 0);
}

TEST(ResumableBounds, OfEqualBalls) {
  const std::vector<Ball> same(200, Ball{{1, 2, 3}, 0.1});
  const Body a = Body::create(same, same).value();
  ResumableBounds search = ResumableBounds::create(a, a, make_pose({5, 0.3, 0.1}, {0.5, 0.6, 0.7})).value();
  EXPECT_TRUE(search.run(20000).ok());
  EXPECT_TRUE(search.is_complete());
}

}  // namespace
}  // namespace medial_vk
