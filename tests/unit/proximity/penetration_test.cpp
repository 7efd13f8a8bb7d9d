// Penetration against closed forms, and against all pairs of balls without a tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/penetration.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

Body body_of_balls(const std::vector<Ball>& balls) { return Body::create(balls, balls).value(); }

/// The volume that two balls have in common.
double volume_of_lens(double r, double s, double d) {
  if (d >= r + s) return 0;
  if (d <= std::fabs(r - s)) return 4 * std::numbers::pi / 3 * std::pow(std::min(r, s), 3);
  return std::numbers::pi * std::pow(r + s - d, 2) * (d * d + 2 * d * (r + s) - 3 * std::pow(r - s, 2)) / (12 * d);
}

/// Balls of b, moved, in the frame of a.
std::vector<Ball> moved_balls(std::span<const Ball> balls, const Pose& pose, const Point& by = {0, 0, 0}) {
  std::vector<Ball> out;
  for (const Ball& ball : balls) out.push_back({pose * ball.centre + by, ball.radius});
  return out;
}

/// The least of all separations; negative where balls overlap.
double least_separation_of(std::span<const Ball> a, std::span<const Ball> b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& p : a) {
    for (const Ball& q : b) least = std::min(least, length(p.centre - q.centre) - p.radius - q.radius);
  }
  return least;
}

/// `size` is at least the sum of all coordinates, reaches and shifts. In the test's own sums of doubles there are fewer
/// than 32 roundings of it.
void expect_consistent(const Penetration& found, const Body& a, const Body& b, const Pose& pose, double size) {
  const double error = 32 * 0x1p-53 * size;
  EXPECT_LE(found.depth_lower, found.depth_upper);
  EXPECT_LE(length(found.translation), found.depth_upper);
  EXPECT_GE(least_separation_of(a.cover(), moved_balls(b.cover(), pose, found.translation)), -error);
  Pose after = pose;
  after.shift = after.shift + found.translation;
  EXPECT_GE(least_separation_of(a.cover(), moved_balls(b.cover(), after)), -error);
  // No translation that is shorter than the lower bound separates the balls inside.
  const double deepest = -least_separation_of(a.inside(), moved_balls(b.inside(), pose));
  EXPECT_GE(found.depth_lower, std::min(deepest, found.depth_upper) - 4 * error - 1e-11 * size);
}

void expect_no_shorter_way(const Penetration& found, const Body& a, const Body& b, const Pose& pose, Random& random,
                           double error) {
  if (found.depth_lower == 0) return;
  for (int i = 0; i < 200; ++i) {
    Point by = point_in_cube(random, 1);
    by = (uniform(random, 0, 1) * found.depth_lower / length(by)) * by;
    EXPECT_LE(least_separation_of(a.inside(), moved_balls(b.inside(), pose, by)), error);
  }
}

TEST(Penetration, OfTwoBallsIsTheirOverlap) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const double r = uniform(random, 0.1, 1), s = uniform(random, 0.1, 1), share = uniform(random, 0.05, 1);
    const Body a = body_of_balls({{{1, 2, 3}, r}}), b = body_of_balls({{{0.5, 0, 0}, s}});
    Pose pose = any_pose(random, {0, 0, 0});
    Point away = point_in_cube(random, 1);
    const double d = share * (r + s);
    pose.shift = Point{1, 2, 3} + (d / length(away)) * away - pose * Point{0.5, 0, 0};
    const Penetration found = penetration(a, b, pose).value();
    const double depth = r + s - d;
    SCOPED_TRACE(testing::Message() << "radii " << r << " and " << s << " at " << d);
    EXPECT_LE(found.depth_lower, depth + 1e-14);
    EXPECT_GE(found.depth_lower, depth - 1e-10);
    EXPECT_GE(found.depth_upper, depth - 1e-14);
    // The search ends at directions 1e-5 apart, where the way out is longer by the square of that, for deep balls
    // relative to the distance of the centres.
    EXPECT_LE(found.depth_upper, depth + 1e-6);
    EXPECT_EQ(found.deepest, (BallPair{0, 0}));
    const double volume = volume_of_lens(r, s, d);
    EXPECT_NEAR(found.common_volume_of_balls, volume, 1e-9);
    EXPECT_LE(found.common_volume_lower, volume + 1e-15);
    EXPECT_GE(found.common_volume_lower, 0.99 * volume);
  }
}

TEST(Penetration, OfBallsWithACommonCentreIsTheSumOfRadii) {
  const Body a = body_of_balls({{{0, 0, 0}, 2}}), b = body_of_balls({{{0, 0, 0}, 0.5}});
  const Penetration found = penetration(a, b, Pose{}).value();
  EXPECT_NEAR(found.depth_lower, 2.5, 1e-9);
  EXPECT_NEAR(found.depth_upper, 2.5, 1e-9);
  EXPECT_NEAR(found.common_volume_of_balls, std::numbers::pi / 6, 1e-9);
  EXPECT_GE(found.common_volume_lower, 0.99 * std::numbers::pi / 6);
  EXPECT_LE(found.common_volume_lower, std::numbers::pi / 6);
}

std::vector<Ball> cloud_of(Random& random, std::size_t count, const Point& middle, double size) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({middle + point_in_cube(random, size), uniform(random, 0.1 * size, 0.4 * size)});
  }
  return balls;
}

TEST(Penetration, OfCloudsHoldsForAllPairs) {
  Random random(2);
  PenetrationOptions options;
  options.directions = 60;
  options.most_queries = 300;
  options.volume_tolerance = 0.1;
  for (const std::size_t count : {1, 2, 9, 60}) {
    for (const double size : {1e-6, 1.0, 1e6}) {
      const Point middle_a = point_in_cube(random, 3 * size), middle_b = point_in_cube(random, 3 * size);
      const Body a = body_of_balls(cloud_of(random, count, middle_a, size)),
                 b = body_of_balls(cloud_of(random, count + 1, middle_b, size));
      for (int i = 0; i < 4; ++i) {
        Pose pose = any_pose(random, {0, 0, 0});
        pose.shift = middle_a - pose * middle_b + point_in_cube(random, 0.8 * size);
        const Penetration found = penetration(a, b, pose, options).value();
        SCOPED_TRACE(testing::Message() << count << " balls of size " << size << ", pose " << i);
        expect_consistent(found, a, b, pose, 40 * size);
        expect_no_shorter_way(found, a, b, pose, random, 1e-13 * size);
        EXPECT_LE(found.common_volume_lower, found.common_volume_of_balls * (1 + 1e-12));
      }
    }
  }
}

/// The common volume by a grid of points, and its standard error.
std::pair<double, double> sampled_volume(std::span<const Ball> a, std::span<const Ball> b, Random& random) {
  constexpr int kSamples = 20000;
  const auto holds = [](std::span<const Ball> balls, const Point& p) {
    return std::ranges::any_of(balls, [&](const Ball& ball) { return length(p - ball.centre) <= ball.radius; });
  };
  int hits = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Point p = point_in_cube(random, 1.4);
    hits += holds(a, p) && holds(b, p);
  }
  const double share = static_cast<double>(hits) / kSamples, box = std::pow(2.8, 3);
  return {share * box, box * std::sqrt(share * (1 - share) / kSamples)};
}

TEST(Penetration, TheVolumeInCommonIsThatOfPoints) {
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    const std::vector<Ball> of_a = cloud_of(random, 30, {0, 0, 0}, 1), of_b = cloud_of(random, 30, {0, 0, 0}, 1);
    PenetrationOptions options;
    options.most_queries = 1;
    options.directions = 1;
    options.most_columns = 50000;
    const Pose pose = any_pose(random, point_in_cube(random, 0.5));
    const Penetration found = penetration(body_of_balls(of_a), body_of_balls(of_b), pose, options).value();
    const auto [volume, error] = sampled_volume(of_a, moved_balls(of_b, pose), random);
    EXPECT_NEAR(found.common_volume_of_balls, volume, 5 * error);
    EXPECT_LE(found.common_volume_lower, found.common_volume_of_balls * (1 + 1e-12));
    EXPECT_GE(found.common_volume_lower, 0.99 * found.common_volume_of_balls);
  }
}

// Two shells of balls, one above the other, in a column: parts of the common volume that are apart.
TEST(Penetration, TheVolumeInCommonMayHaveSeveralParts) {
  const Body comb = body_of_balls({{{0, 0, 0}, 1}, {{0, 0, 3}, 1}, {{0, 0, 6}, 1}, {{2.5, 0, 3}, 2}});
  const Body rod = body_of_balls({{{0, 0, 0}, 0.5}, {{0, 0, 3}, 0.5}, {{0, 0, 6}, 0.5}});
  const Penetration found = penetration(comb, rod, Pose{}).value();
  const double volume = 3 * std::numbers::pi / 6;
  EXPECT_NEAR(found.common_volume_of_balls, volume, 1e-9);
  EXPECT_LE(found.common_volume_lower, volume);
  EXPECT_GE(found.common_volume_lower, 0.99 * volume);
}

/// Balls in a box of this size that fill much of it, and balls that cover it: by a grid of cells.
Body box_body(const Point& size, int cells) {
  std::vector<Ball> inside, cover;
  const Point cell = {size[0] / cells, size[1] / cells, size[2] / cells};
  const double radius = 0.5 * std::min({cell[0], cell[1], cell[2]});
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        const Point centre = {(i + 0.5) * cell[0], (j + 0.5) * cell[1], (k + 0.5) * cell[2]};
        inside.push_back({centre, radius});
        cover.push_back({centre, 0.5 * length(cell) * (1 + 1e-12)});
      }
    }
  }
  const double largest = 0.5 * std::min({size[0], size[1], size[2]});
  inside.push_back({0.5 * size, largest});
  return Body::create(indexed(prepare_mesh(make_box(size)).value()), inside, cover).value();
}

TEST(Penetration, OfTwoBoxesIsTheLeastOverlapOfTheirFaces) {
  const int cells = 8;
  const Body a = box_body({1, 1, 1}, cells), b = box_body({1, 2, 1}, cells);
  for (const Point& shift : {Point{0.7, 0.1, -0.2}, Point{-0.2, 0.3, 0.6}, Point{0.1, -1.5, 0.2}}) {
    Pose pose;
    pose.shift = shift + Point{0, 0, 0};
    // Both boxes have a corner at the origin of their frames.
    const double x = std::min(1 - shift[0], 1 + shift[0]), y = std::min(1 - shift[1], 2 + shift[1]),
                 z = std::min(1 - shift[2], 1 + shift[2]);
    const double depth = std::min({x, y, z});
    const Penetration found = penetration(a, b, pose).value();
    EXPECT_LE(found.depth_lower, depth);
    EXPECT_GE(found.depth_upper, depth);
    // Balls of the covers reach out of a face by half of a diagonal less half a side.
    const double out = 0.5 * (std::sqrt(3.0) - 1) / cells + 0.5 * (std::sqrt(6.0) - 1) / cells;
    EXPECT_LE(found.depth_upper, depth + out);
    EXPECT_GT(found.depth_lower, 0);
    const double both = (std::min(1.0, 1 + shift[0]) - std::max(0.0, shift[0])) *
                        (std::min(1.0, 2 + shift[1]) - std::max(0.0, shift[1])) *
                        (std::min(1.0, 1 + shift[2]) - std::max(0.0, shift[2]));
    EXPECT_LE(found.common_volume_lower, both);
    EXPECT_GT(found.common_volume_lower, 0.1 * both);
  }
}

TEST(Penetration, OfSolidsThatAreApartIsZero) {
  const Body a = box_body({1, 1, 1}, 3);
  for (const double x : {1.001, 1.2, 10.0}) {  // by triangles, where the covers overlap, and by the covers
    const Penetration found = penetration(a, a, make_pose({x, 0, 0}, {0, 0, 0})).value();
    EXPECT_EQ(found.depth_lower, 0);
    EXPECT_EQ(found.depth_upper, 0);
    EXPECT_EQ(found.translation, (Point{0, 0, 0}));
    EXPECT_EQ(found.common_volume_lower, 0);
    EXPECT_EQ(found.common_volume_of_balls, 0);
    EXPECT_EQ(found.deepest, BallPair{});
  }
}

TEST(Penetration, OfBallsThatTouchIsNothing) {
  const Body a = body_of_balls({{{0, 0, 0}, 1}}), b = body_of_balls({{{0, 0, 0}, 2}});
  const Penetration found = penetration(a, b, make_pose({3, 0, 0}, {0, 0, 0})).value();
  EXPECT_LE(found.depth_lower, 0);
  EXPECT_LE(found.depth_upper, 1e-9);
  EXPECT_GE(least_separation_of(a.cover(), moved_balls(b.cover(), make_pose({3, 0, 0}, {0, 0, 0}), found.translation)),
            0);
  EXPECT_EQ(found.common_volume_lower, 0);
}

TEST(Penetration, WithoutASetThereIsNoBoundOfItsKind) {
  const Body inside = Body::create(std::vector<Ball>{{{0, 0, 0}, 1}}, {}).value(),
             cover = Body::create({}, std::vector<Ball>{{{0, 0, 0}, 1}}).value();
  const Pose pose = make_pose({0.5, 0, 0}, {0, 0, 0});
  const Penetration by_inside = penetration(inside, inside, pose).value(),
                    by_cover = penetration(cover, cover, pose).value();
  EXPECT_NEAR(by_inside.depth_lower, 1.5, 1e-9);
  EXPECT_EQ(by_inside.depth_upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(by_cover.depth_lower, 0);
  EXPECT_NEAR(by_cover.depth_upper, 1.5, 1e-6);
  EXPECT_EQ(by_cover.common_volume_lower, 0);
}

TEST(Penetration, OfEqualBodiesAndDistantOnes) {
  Random random(4);
  PenetrationOptions options;
  options.directions = 30;
  options.most_queries = 300;
  options.volume_tolerance = 1;
  const std::vector<Ball> balls = cloud_of(random, 40, {1e6, -1e6, 2e6}, 1);
  const Body a = body_of_balls(balls);
  expect_consistent(penetration(a, a, Pose{}, options).value(), a, a, Pose{}, 1.5e7);
  Pose pose = any_pose(random, {0, 0, 0});
  const Point middle = {1e6, -1e6, 2e6};
  pose.shift = middle - pose * middle + Point{0.5, 0.2, 0.1};
  const Penetration found = penetration(a, a, pose, options).value();
  EXPECT_GT(found.depth_lower, 0);
  EXPECT_LT(found.depth_upper, 4);
  expect_consistent(found, a, a, pose, 1.5e7);
}

TEST(Penetration, OfPointsAndOfManyEqualBalls) {
  const Body points = body_of_balls(std::vector<Ball>(20, Ball{{1, 2, 3}, 0}));
  const Penetration of_points = penetration(points, points, Pose{}).value();
  EXPECT_EQ(of_points.depth_lower, 0);
  EXPECT_LE(of_points.depth_upper, 1e-9);
  EXPECT_EQ(of_points.common_volume_lower, 0);
  const Body same = body_of_balls(std::vector<Ball>(60, Ball{{1, 2, 3}, 0.5}));
  const Penetration of_same = penetration(same, same, make_pose({0.3, 0, 0}, {0, 0, 0})).value();
  EXPECT_NEAR(of_same.depth_lower, 0.7, 1e-9);
  EXPECT_NEAR(of_same.depth_upper, 0.7, 1e-6);
  EXPECT_NEAR(of_same.common_volume_of_balls, volume_of_lens(0.5, 0.5, 0.3), 1e-9);
}

TEST(Penetration, OfTheLargestBallsAndShifts) {
  const Body a = body_of_balls({{{9e17, -9e17, 9e17}, 1e17}}), b = body_of_balls({{{0, 0, 0}, 1}});
  const Penetration found = penetration(a, b, make_pose({9e17, -9e17, 9e17}, {0, 0, 0})).value();
  EXPECT_LE(found.depth_lower, 1e17 * (1 + 1e-12));
  EXPECT_GE(found.depth_upper, 1e17);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double beyond : {1e20, infinite, std::nan("")}) {
    const Penetration none = penetration(b, b, make_pose({beyond, 0, 0}, {0, 0, 0})).value();
    EXPECT_EQ(none.depth_lower, 0);
    EXPECT_EQ(none.depth_upper, infinite);
  }
}

TEST(Penetration, RefusesOptionsOutOfRange) {
  const Body a = body_of_balls({{{0, 0, 0}, 1}});
  const auto message = [&](const PenetrationOptions& options) {
    const Result<Penetration> found = penetration(a, a, Pose{}, options);
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    return found.error().message;
  };
  EXPECT_THAT(message({.directions = 0}), testing::HasSubstr("`directions`"));
  EXPECT_THAT(message({.volume_tolerance = -1}), testing::HasSubstr("`volume_tolerance`"));
  EXPECT_THAT(message({.volume_tolerance = std::nan("")}), testing::HasSubstr("`volume_tolerance`"));
}

}  // namespace
}  // namespace medial_vk
