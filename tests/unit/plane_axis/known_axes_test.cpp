// Axes that are known in closed form, degenerate shapes, and errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "medial_vk/plane_axis.h"
#include "support/plane_axis/ring_shapes.h"

namespace medial_vk::test {
namespace {

constexpr double kPi = std::numbers::pi;

PlaneAxis axis_of(const std::vector<PlaneRing>& rings, double object_angle, FillRule rule = FillRule::kEvenOdd) {
  PlaneAxisOptions options;
  options.object_angle = object_angle;
  Result<PlaneAxis> axis = find_plane_axis(prepared(rings, rule), options);
  EXPECT_TRUE(axis.ok());
  return axis.ok() ? std::move(axis.value()) : PlaneAxis();
}

PlaneRing circle(int corners, double radius) {
  PlaneRing ring;
  for (int i = 0; i < corners; ++i) {
    ring.push_back({radius * std::cos(2 * kPi * i / corners), radius * std::sin(2 * kPi * i / corners)});
  }
  return ring;
}

TEST(KnownAxes, ARectangleHasFiveBranches) {
  const PlaneAxis axis = axis_of({{{0, 0}, {8, 0}, {8, 6}, {0, 6}}}, 0.6);
  EXPECT_EQ(axis.branches.size(), 5u);
  EXPECT_EQ(axis.junctions(), 2u);
  double length = 0;
  for (const AxisBranch& branch : axis.branches) length += branch.length;
  EXPECT_NEAR(length, 2 + 4 * 3 * std::numbers::sqrt2, 1e-12);
  for (const AxisNode& node : axis.nodes) {
    EXPECT_NEAR(node.radius, node.degree == 3 ? 3 : 0, 1e-12);
    EXPECT_NEAR(node.object_angle, node.degree == 3 ? kPi / 2 : kPi / 4, 1e-12);
  }
}

TEST(KnownAxes, ABranchBelowTheThresholdIsLeftOut) {
  const PlaneAxis axis = axis_of({{{0, 0}, {8, 0}, {8, 6}, {0, 6}}}, 0.8);  // corners have pi / 4
  ASSERT_EQ(axis.branches.size(), 1u);
  EXPECT_NEAR(axis.branches[0].length, 2, 1e-12);
}

TEST(KnownAxes, TheRadiusKeepsDeepPoints) {
  PlaneAxisOptions options;
  options.object_angle = 0.8;
  options.radius = 1;
  const auto axis = find_plane_axis(prepared({{{0, 0}, {8, 0}, {8, 6}, {0, 6}}}), options);
  ASSERT_TRUE(axis.ok());
  double length = 0;
  for (const AxisBranch& branch : axis.value().branches) length += branch.length;
  EXPECT_NEAR(length, 2 + 4 * 2 * std::numbers::sqrt2, 1e-12);
}

TEST(KnownAxes, ATriangleMeetsInItsIncentre) {
  const PlaneAxis axis = axis_of({{{0, 0}, {4, 0}, {0, 3}}}, 0);
  ASSERT_EQ(axis.junctions(), 1u);
  const auto centre = std::ranges::find_if(axis.nodes, [](const AxisNode& n) { return n.degree == 3; });
  EXPECT_NEAR(centre->point[0], 1, 1e-12);
  EXPECT_NEAR(centre->point[1], 1, 1e-12);
  EXPECT_NEAR(centre->radius, 1, 1e-12);
}

/// The reflex corner of an L and the outer sides are equally far on parabolas.
TEST(KnownAxes, AReflexCornerGivesParabolas) {
  const PlaneAxis axis = axis_of({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, 0.3);
  const auto is_parabola = [](const AxisArc& arc) { return arc.curve.kind == PlaneCurve::Kind::kOfPointAndSegment; };
  ASSERT_EQ(std::ranges::count_if(axis.arcs, is_parabola), 2);
  for (const AxisArc& arc : axis.arcs) {
    if (!is_parabola(arc)) continue;
    EXPECT_NEAR(arc.curve.focus, 1, 1e-12);
    const PlanePoint x = arc.curve.point_at((arc.t[0] + arc.t[1]) / 2);
    EXPECT_NEAR(std::hypot(x[0] - 1, x[1] - 1), std::min(x[0], x[1]), 1e-12);
  }
}

TEST(KnownAxes, ARegularPolygonIsAStarOrItsCentre) {
  for (const int corners : {5, 12, 100}) {
    const PlaneAxis star = axis_of({circle(corners, 1)}, 0);
    EXPECT_EQ(star.branches.size(), static_cast<std::size_t>(corners));
    EXPECT_EQ(star.junctions(), 1u);
  }
  const PlaneAxis centre = axis_of({circle(3000, 1)}, 0.5);
  EXPECT_TRUE(centre.arcs.empty());
  ASSERT_EQ(centre.nodes.size(), 1u);
  EXPECT_NEAR(std::hypot(centre.nodes[0].point[0], centre.nodes[0].point[1]), 0, centre.epsilon);
  EXPECT_NEAR(centre.nodes[0].radius, std::cos(kPi / 3000), centre.epsilon);
}

TEST(KnownAxes, ARingIsOneLoop) {
  const PlaneAxis axis = axis_of({circle(40, 3), circle(40, 1)}, 0.5);
  ASSERT_EQ(axis.branches.size(), 1u);
  EXPECT_EQ(axis.branches[0].ends[0], axis.branches[0].ends[1]);
  EXPECT_EQ(axis.junctions(), 0u);
}

TEST(KnownAxes, SquaresOnAGridMeetInFours) {
  std::vector<PlaneRing> rings = {{{0, 0}, {5, 0}, {5, 5}, {0, 5}}};
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      rings.push_back({{x + 0.25, y + 0.25}, {x + 0.75, y + 0.25}, {x + 0.75, y + 0.75}, {x + 0.25, y + 0.75}});
    }
  }
  const PlaneAxis axis = axis_of(rings, 0.3);
  EXPECT_EQ(std::ranges::count_if(axis.nodes, [](const AxisNode& n) { return n.degree == 4; }), 16);
}

TEST(KnownAxes, ACutAndATouchingCornerAreAnswered) {
  // Two squares that touch in a corner, and a triangle with a corner on a side.
  const PlaneAxis axis =
      axis_of({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, {{2, 1.5}, {3, 1}, {3, 2}}}, 0.3);
  EXPECT_EQ(axis.junctions(), 3u);
}

TEST(KnownAxes, BadOptionsAreRefused) {
  const PreparedShape shape = prepared({{{0, 0}, {1, 0}, {0, 1}}});
  PlaneAxisOptions options;
  options.object_angle = 2;
  EXPECT_EQ(find_plane_axis(shape, options).error().code, ErrorCode::kUsage);
  options = {};
  options.radius = std::numeric_limits<double>::infinity();
  EXPECT_EQ(find_plane_axis(shape, options).error().code, ErrorCode::kUsage);
  options = {};
  options.margin = -1;
  EXPECT_EQ(find_plane_axis(shape, options).error().code, ErrorCode::kUsage);
  EXPECT_EQ(find_plane_axis(PreparedShape()).error().code, ErrorCode::kInvalidMesh);
}

TEST(KnownAxes, ProgressEndsWithTheWork) {
  PlaneAxisOptions options;
  options.threads = 1;
  std::vector<double> shares;
  ASSERT_TRUE(find_plane_axis(prepared({circle(1000, 1)}), options, [&](double done) { shares.push_back(done); }).ok());
  ASSERT_GE(shares.size(), 4u);
  EXPECT_LT(shares.front(), 0.5);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
}

TEST(KnownAxes, AStopIsObeyed) {
  std::stop_source stop;
  stop.request_stop();
  const PreparedShape shape = prepared({circle(100, 1)});
  EXPECT_EQ(find_plane_axis(shape, {}, {}, stop.get_token()).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(prepare_shape(std::vector<PlaneRing>{circle(100, 1)}, FillRule::kNonZero, 1, stop.get_token()).error().code,
            ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk::test
