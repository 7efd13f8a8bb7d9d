// Distances of points and of hulls against the reference, and where they are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"
#include "cpu_reference/ball_hulls.h"
#include "medial_vk/ball_hull.h"
#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

using test::distance_rounding;
using test::PairFamily;
using test::random_hull;
using test::reference_hull;

Point point_between(double low, double high, std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(low, high);
  Point p{};
  for (double& x : p) x = number(random);
  return p;
}

Point direction_of(std::mt19937_64& random) {
  for (;;) {
    const Point p = point_between(-1, 1, random);
    const double size = length(p);
    if (size > 0.1 && size < 1) return (1 / size) * p;
  }
}

class HullDistanceOf : public testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t>> {};

TEST_P(HullDistanceOf, IsThatOfTheReferenceForAllFamilies) {
  const auto& [first_count, second_count] = GetParam();
  std::mt19937_64 random(100 * first_count + second_count);
  constexpr int kPairs = 20'000;
  for (int i = 0; i < kPairs && !HasFailure(); ++i) {
    const auto family = static_cast<PairFamily>(i % static_cast<int>(PairFamily::kCount));
    const auto [a, b] = test::random_pair(first_count, second_count, family, random);
    const double expected = reference::hull_distance(reference_hull(a), reference_hull(b));
    const double rounding = distance_rounding(a, b);
    EXPECT_NEAR(distance_between(a, b), expected, rounding) << "pair " << i;
    EXPECT_NEAR(distance_between(b, a), expected, rounding) << "pair " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, HullDistanceOf,
                         testing::Combine(testing::Values(1u, 2u, 3u), testing::Values(1u, 2u, 3u)));

TEST(HullDistance, OfAPointIsThatOfTheReference) {
  std::mt19937_64 random(5);
  for (std::uint32_t i = 0; i < 30'000 && !HasFailure(); ++i) {
    const BallHull hull = random_hull(1 + i % 3, random);
    const BallHull point = hull_of({point_between(-1.5, 1.5, random), 0});
    const Point& p = point.corners[0].centre;
    const double expected = reference::hull_distance(reference_hull(hull), reference_hull(point));
    const double rounding = distance_rounding(hull, point);
    EXPECT_NEAR(signed_distance(hull, p), expected, rounding) << "hull " << i;
    // The ball that is said to be nearest has that distance.
    const AxisPoint nearest = AxisQuery(hull).nearest(p);
    const Ball ball = ball_at(hull, nearest.weight);
    EXPECT_NEAR(nearest.distance, expected, rounding) << "hull " << i;
    EXPECT_NEAR(length(p - ball.centre) - ball.radius, expected, 4 * rounding) << "hull " << i;
    for (const double weight : nearest.weight) EXPECT_GE(weight, 0);
  }
}

// The theorem: inside, too, it is the distance to the surface, so that planes that touch the hull are at least as far,
// and one of them is not farther.
TEST(HullDistance, OfAPointIsThatToTheSurfaceOnEitherSide) {
  std::mt19937_64 random(6);
  for (std::uint32_t i = 0; i < 3000 && !HasFailure(); ++i) {
    const BallHull hull = random_hull(1 + i % 3, random);
    const Point p = point_between(-1, 1, random);
    const double distance = signed_distance(hull, p);
    const double rounding = 4 * distance_rounding(hull, hull_of({p, 0}));
    for (int k = 0; k < 30; ++k) {
      const Point n = direction_of(random);
      EXPECT_GE(distance, dot(n, p) - support(hull, n) - rounding) << "hull " << i;
    }
    // From the nearest ball through the point; on the axis a direction perpendicular to it will do.
    const Ball ball = ball_at(hull, AxisQuery(hull).nearest(p).weight);
    const Point out = p - ball.centre;
    if (length(out) < 1e-3) continue;
    const Point n = (1 / length(out)) * out;
    EXPECT_NEAR(distance, dot(n, p) - support(hull, n), 1e4 * rounding) << "hull " << i;
  }
}

TEST(HullDistance, OfAPointIsConvex) {
  std::mt19937_64 random(7);
  for (std::uint32_t i = 0; i < 3000 && !HasFailure(); ++i) {
    const BallHull hull = random_hull(1 + i % 3, random);
    const Point p = point_between(-1.5, 1.5, random), q = point_between(-1.5, 1.5, random);
    const double middle = signed_distance(hull, 0.5 * (p + q));
    EXPECT_LE(middle, 0.5 * (signed_distance(hull, p) + signed_distance(hull, q)) +
                          4 * distance_rounding(hull, hull_of({p, 0}, {q, 0})));
  }
}

TEST(HullDistance, OfKnownPairs) {
  // Two crossed capsules, one above the other.
  const BallHull along_x = hull_of({{-1, 0, 0}, 0.25}, {{1, 0, 0}, 0.25});
  const BallHull along_y = hull_of({{0.5, -1, 2}, 0.5}, {{0.5, 1, 2}, 0.5});
  EXPECT_DOUBLE_EQ(distance_between(along_x, along_y), 1.25);
  // Parallel capsules, side by side and one behind the other.
  EXPECT_DOUBLE_EQ(distance_between(along_x, hull_of({{0.5, 1, 0}, 0.25}, {{3, 1, 0}, 0.25})), 0.5);
  EXPECT_DOUBLE_EQ(distance_between(along_x, hull_of({{2, 0, 0}, 0.25}, {{3, 0, 0}, 0.25})), 0.5);
  // An edge through a triangle, away from the ends of both: the centres coincide, and nothing but the radii is left.
  const BallHull slab = hull_of({{-3, -3, 0}, 0.25}, {{3, -3, 0}, 0.25}, {{0, 3, 0}, 0.25});
  EXPECT_DOUBLE_EQ(distance_between(slab, hull_of({{0, 0, -2}, 0.125}, {{0, 0, 2}, 0.125})), -0.375);
  // Two parallel slabs; two triangles of radius 0 that cross.
  const BallHull above = hull_of({{-3, -3, 1}, 0.25}, {{3, -3, 1}, 0.25}, {{0, 3, 1}, 0.25});
  EXPECT_DOUBLE_EQ(distance_between(slab, above), 0.5);
  const BallHull flat = hull_of({{-3, -3, 0}, 0}, {{3, -3, 0}, 0}, {{0, 3, 0}, 0});
  const BallHull upright = hull_of({{0, 0, -1}, 0}, {{0, 0, 1}, 0}, {{0, 5, 0}, 0});
  EXPECT_EQ(distance_between(flat, upright), 0);
  // A ball beside a cone whose slope is 0.6: the foot is ahead by 3/4 of the height.
  const BallHull cone = hull_of({{0, 0, 0}, 0.5}, {{10, 0, 0}, 6.5});
  EXPECT_NEAR(signed_distance(cone, {1, 8, 0}), 8 * 0.8 - 0.6 * 1 - 0.5, 1e-14);
}

TEST(HullDistance, OfHullsFarFromTheOriginIsThatOfTheirDifferences) {
  std::mt19937_64 random(8);
  for (std::uint32_t i = 0; i < 500; ++i) {
    auto [a, b] = test::random_pair(1 + i % 3, 1 + i / 3 % 3, PairFamily::kGeneral, random);
    // Multiples of 2^-20, which moving by 2^20 leaves exact.
    for (BallHull* hull : {&a, &b}) {
      for (Ball& ball : hull->corners) {
        for (double& x : ball.centre) x = std::round(x * 0x1p20) * 0x1p-20;
      }
    }
    const double near = distance_between(a, b);
    for (BallHull* hull : {&a, &b}) {
      for (Ball& ball : hull->corners) ball.centre = ball.centre + Point{0x1p20, -0x1p20, 0x1p19};
    }
    EXPECT_NEAR(distance_between(a, b), near, 0x1p-45);
  }
}

}  // namespace
}  // namespace medial_vk
