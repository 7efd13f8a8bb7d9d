// Shapes made ready: windings, crossings, overlaps and touching points.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plane/shapes/orientation.h"
#include "support/plane_axis/exact_distances.h"
#include "support/plane_axis/ring_shapes.h"

namespace medial_vk::test {
namespace {

PlaneRing square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST(PrepareShape, TheInsideIsOnTheLeftWhicheverWayARingGoes) {
  PlaneRing ring = square(0, 0, 2);
  for (int i = 0; i < 2; ++i) {
    const PreparedShape shape = prepared({ring});
    EXPECT_EQ(shape.segments.size(), 4u);
    EXPECT_DOUBLE_EQ(shape.report.area, 4);
    EXPECT_DOUBLE_EQ(shape.report.perimeter, 8);
    EXPECT_TRUE(shape.report.assumptions.empty());
    std::ranges::reverse(ring);
  }
}

TEST(PrepareShape, NestedRingsAreHolesByTheEvenOddRuleAlone) {
  const std::vector<PlaneRing> rings = {square(0, 0, 4), square(1, 1, 2)};
  EXPECT_DOUBLE_EQ(prepared(rings, FillRule::kEvenOdd).report.area, 12);
  const PreparedShape filled = prepared(rings, FillRule::kNonZero);
  EXPECT_DOUBLE_EQ(filled.report.area, 16);
  EXPECT_EQ(filled.report.inner_segments, 4u);
}

TEST(PrepareShape, CrossingsAreCut) {
  const std::vector<PlaneRing> rings = {square(0, 0, 2), square(1, 1, 2)};
  const PreparedShape both = prepared(rings, FillRule::kNonZero);
  EXPECT_DOUBLE_EQ(both.report.area, 7);
  EXPECT_EQ(both.report.crossings, 2u);
  EXPECT_EQ(both.segments.size(), 8u);
  EXPECT_DOUBLE_EQ(prepared(rings, FillRule::kEvenOdd).report.area, 6);
}

TEST(PrepareShape, SharedSidesGo) {
  const PreparedShape shape = prepared({square(0, 0, 1), square(1, 0, 1), square(1, 0.5, 1)});
  EXPECT_DOUBLE_EQ(shape.report.area, 2.5);
  EXPECT_DOUBLE_EQ(shape.report.perimeter, 7);
  EXPECT_GT(shape.report.inner_segments, 0u);
  // The same square twice is once.
  EXPECT_DOUBLE_EQ(prepared({square(0, 0, 1), square(0, 0, 1)}).report.area, 1);
}

TEST(PrepareShape, ABowTieHasTwoParts) {
  const PreparedShape shape = prepared({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}});
  EXPECT_DOUBLE_EQ(shape.report.area, 2);
  EXPECT_EQ(shape.segments.size(), 6u);
}

TEST(PrepareShape, TouchingPointsCutSegments) {
  const PreparedShape shape = prepared({square(0, 0, 2), {{2, 1}, {3, 0}, {3, 2}}});
  EXPECT_EQ(shape.report.touching_points, 1u);
  EXPECT_EQ(shape.segments.size(), 8u);
}

TEST(PrepareShape, PointsWithinTheToleranceAreOne) {
  const PreparedShape shape = prepared({{{0, 0}, {1, 0}, {1, 1}, {1 - 1e-15, 1}, {0, 1}}});
  EXPECT_EQ(shape.segments.size(), 4u);
  EXPECT_GT(shape.report.tolerance, 1e-15);
}

TEST(PrepareShape, NothingIsNoShape) {
  EXPECT_EQ(prepare_shape({}).error().code, ErrorCode::kInvalidMesh);
  const std::vector<PlaneRing> flat = {{{0, 0}, {1, 0}, {2, 0}}, {{0, 0}, {1, 1}}, {}};
  const auto refused = prepare_shape(flat);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "the rings of the shape enclose nothing");
  const std::vector<PlaneRing> infinite = {{{0, 0}, {1, 0}, {0, std::numeric_limits<double>::infinity()}}};
  EXPECT_EQ(prepare_shape(infinite).error().message,
            "point 2 of ring 0 has a coordinate that is not finite or beyond 1e150");
}

TEST(PrepareShape, SegmentsMeetInCommonPointsOnly) {
  using plane::orientation, plane::Vec2;
  for (std::uint64_t seed = 0; seed < 70; ++seed) {
    SCOPED_TRACE(seed);
    const PreparedShape shape = prepared(rings_of_seed(seed), FillRule::kEvenOdd);
    const auto at = [&](std::uint32_t p) { return Vec2{shape.points[p][0], shape.points[p][1]}; };
    for (std::size_t i = 0; i < shape.segments.size(); ++i) {
      for (std::size_t k = i + 1; k < shape.segments.size(); ++k) {
        const auto [a, b] = shape.segments[i];
        const auto [c, d] = shape.segments[k];
        if (a == c || a == d || b == c || b == d) continue;
        const bool separates = orientation(at(a), at(b), at(c)) * orientation(at(a), at(b), at(d)) >= 0;
        EXPECT_TRUE(separates || orientation(at(c), at(d), at(a)) * orientation(at(c), at(d), at(b)) >= 0);
      }
    }
  }
}

/// The winding number of the rings says what is inside, and the segments say the same.
TEST(PrepareShape, TheInsideIsThatOfTheRings) {
  std::mt19937_64 random(3);
  for (std::uint64_t seed = 0; seed < 70; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<PlaneRing> rings = rings_of_seed(seed);
    const FillRule rule = seed % 2 == 0 ? FillRule::kEvenOdd : FillRule::kNonZero;
    const PreparedShape shape = prepared(rings, rule);
    for (int i = 0; i < 100; ++i) {
      std::uniform_real_distribution<> share(-0.1, 1.1);
      const double x = shape.report.lower[0] + share(random) * (shape.report.upper[0] - shape.report.lower[0]);
      const double y = shape.report.lower[1] + share(random) * (shape.report.upper[1] - shape.report.lower[1]);
      double angle = 0;
      for (const PlaneRing& ring : rings) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const PlanePoint &p = ring[k], &q = ring[(k + 1) % ring.size()];
          const double ux = p[0] - x, uy = p[1] - y, vx = q[0] - x, vy = q[1] - y;
          angle += std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
        }
      }
      const long winding = std::lround(angle / (2 * std::numbers::pi));
      EXPECT_EQ(is_inside(shape, {x, y}), rule == FillRule::kNonZero ? winding != 0 : winding % 2 != 0);
    }
  }
}

}  // namespace
}  // namespace medial_vk::test
