// How near hulls come to triangles, against the dual of the reference: a triangle is a hull with radii 0.
#include "ball_hulls/triangle_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "cpu_reference/ball_hulls.h"
#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

using Corners = std::array<Point, 3>;

double between(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

BallHull flat_hull(const Corners& triangle) {
  return hull_of(Ball{triangle[0], 0}, Ball{triangle[1], 0}, Ball{triangle[2], 0});
}

/// The value at the weights that were found, without the closed forms that found them.
double distance_at(const BallHull& hull, const AxisPoint& found, const Corners& triangle) {
  const Ball ball = ball_at(hull, found.weight);
  return std::sqrt(nearest_on_triangle(ball.centre, triangle).squared_distance) - ball.radius;
}

/// The height of a triangle as a share of its longest side; 1 for a hull of fewer balls.
double thinness(const BallHull& hull) {
  if (hull.count < 3) return 1;
  const Point &a = hull.corners[0].centre, &b = hull.corners[1].centre, &c = hull.corners[2].centre;
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  return longest > 0 ? length(cross(b - a, c - a)) / (longest * longest) : 0;
}

/// The value that is found belongs to a ball and a point of the triangle, so it is not too small. It may be too great
/// where an edge passes through a triangle of length L and height h: its normal has an error of some units in the last
/// place times L / h, by which the meeting point is misplaced or missed; but an edge of the triangle is never farther
/// than h. So it is at most the square root of 2^-53 times L, and some units.
double excess_of_thin(const BallHull& first, const BallHull& second) {
  const double unit = test::distance_rounding(first, second) / 64;
  const double thin = std::min(thinness(first), thinness(second));
  return std::max(64 * unit, std::min(16 * unit / thin, 0x1p26 * unit));
}

void expect_nearest(const BallHull& hull, const Corners& triangle, const char* what, int number) {
  const AxisQuery query(hull);
  const AxisPoint found = TriangleGap(query).nearest(triangle);
  const BallHull flat = flat_hull(triangle);
  const double expected = reference::hull_distance(test::reference_hull(hull), test::reference_hull(flat));
  const double rounding = test::distance_rounding(hull, flat);
  const double excess = excess_of_thin(hull, flat);
  EXPECT_GE(found.distance, expected - rounding) << what << ' ' << number;
  EXPECT_LE(found.distance, expected + excess) << what << ' ' << number;
  double sum = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_GE(found.weight[i], i < hull.count ? -1e-15 : 0) << what << ' ' << number;  // a rounded difference from 1
    sum += found.weight[i];
  }
  EXPECT_NEAR(sum, 1, 1e-12) << what << ' ' << number;
  EXPECT_GE(distance_at(hull, found, triangle), expected - rounding) << what << ' ' << number;
  EXPECT_LE(distance_at(hull, found, triangle), expected + excess) << what << ' ' << number;
}

Corners corners_of(const BallHull& hull) {
  return {hull.corners[0].centre, hull.corners[1].centre, hull.corners[2].centre};
}

// Crossing pairs, where an edge of one axis goes through the other, and parallel ones are among the families.
TEST(TriangleGap, IsThatOfTheReference) {
  for (std::uint32_t count = 1; count <= 3; ++count) {
    for (int i = 0; i < 4'000; ++i) {
      std::mt19937_64 random(static_cast<std::uint64_t>(i) * 4 + count);
      const auto family = static_cast<test::PairFamily>(i % static_cast<int>(test::PairFamily::kCount));
      const test::HullPair pair = test::random_pair(count, 3, family, random);
      expect_nearest(pair.first, corners_of(pair.second), "pair", i);
    }
  }
}

TEST(TriangleGap, OfDegenerateTriangles) {
  for (std::uint32_t count = 1; count <= 3; ++count) {
    for (int i = 0; i < 1'500; ++i) {
      std::mt19937_64 random(static_cast<std::uint64_t>(i) * 4 + count);
      const BallHull hull = test::random_hull(count, random);
      Corners triangle = corners_of(test::random_hull(3, test::HullFamily::kGeneral, random));
      switch (i % 4) {
        case 0:
          triangle[2] = triangle[1];
          break;
        case 1:
          triangle[1] = triangle[2] = triangle[0];
          break;
        case 2:  // on a line, as exactly as doubles allow
          triangle[2] = triangle[0] + between(-1, 2, random) * (triangle[1] - triangle[0]);
          break;
        default:  // with a corner at a ball of the hull
          triangle[0] = hull.corners[0].centre;
      }
      expect_nearest(hull, triangle, "degenerate triangle", i);
    }
  }
}

/// Axes that pierce the triangle in its inside, on an edge and at a corner, and edges that pierce the axis.
TEST(TriangleGap, OfPiercingAxes) {
  const Corners triangle = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  for (const auto& [x, y] : {std::array<double, 2>{1, 1}, {2, 0}, {2, 2}, {0, 0}}) {
    const BallHull capsule = hull_of(Ball{{x, y, -1}, 0.25}, Ball{{x, y, 3}, 0.5});
    const AxisQuery query(capsule);
    const AxisPoint found = TriangleGap(query).nearest(triangle);
    // Above the triangle radii grow more slowly than distances.
    EXPECT_DOUBLE_EQ(found.distance, -0.3125) << x << ' ' << y;
    EXPECT_DOUBLE_EQ(found.weight[1], 0.25) << x << ' ' << y;
  }
  // The triangle's plane cuts the axis from (1, 1) to (3, 1), of which the part up to (2, 2) ... (3, 1) is inside.
  const BallHull slab = hull_of(Ball{{1, 1, -1}, 0.5}, Ball{{1, 1, 1}, 0.25}, Ball{{5, 1, 1}, 0.25});
  expect_nearest(slab, triangle, "slab", 0);
}

}  // namespace
}  // namespace medial_vk
