// Section 4.4: points of the axis by discs, against the exact axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stop_token>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_thesis.h"
#include "support/plane_thesis/axis_distance.h"
#include "support/plane_thesis/random_shapes.h"

namespace medial_vk {
namespace {

PreparedShape shape_of(unsigned family, std::uint64_t seed) {
  return prepare_shape(test::random_shape(family, seed), FillRule::kEvenOdd, 1).value();
}

double between(PlanePoint a, PlanePoint b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

class PublishedAxisTest : public testing::TestWithParam<unsigned> {};

TEST_P(PublishedAxisTest, PointsAreWithinEpsilonOfTheExactAxis) {
  const PreparedShape shape = shape_of(GetParam(), 1);
  PlaneThesisOptions options;
  options.object_angle = 0.3;
  options.epsilon = 1e-6;
  const PublishedAxis found = find_plane_axis_as_published(shape, options).value();
  PlaneAxisOptions exact;
  exact.object_angle = 0;
  const PlaneAxis axis = find_plane_axis(shape, exact).value();
  const PlaneBoundary boundary = PlaneBoundary::build(shape).value();
  ASSERT_GT(found.points.size(), 20u);
  EXPECT_EQ(found.discs, found.undetermined + found.decided[0] + found.decided[1] + found.decided[2]);
  const std::size_t step = std::max<std::size_t>(1, found.points.size() / 200);
  for (std::size_t i = 0; i < found.points.size(); i += step) {
    const PublishedPoint& p = found.points[i];
    EXPECT_LE(test::distance_to_axis(axis, p.point), 1.01e-6);
    EXPECT_GE(p.object_angle, options.object_angle);
    EXPECT_NEAR(p.radius, boundary.nearest(p.point).distance, 1e-14);
    EXPECT_NEAR(p.radius, between(p.point, p.feet[0]), 1e-14);
    // Lemma 2.4, for the foot that is nearest to a point within epsilon.
    EXPECT_NEAR(p.radius, between(p.point, p.feet[1]), 2e-6 + 1e-14);
  }
}

TEST_P(PublishedAxisTest, MissesNoPointAboveItsBounds) {
  const PreparedShape shape = shape_of(GetParam(), 2);
  PlaneThesisOptions options;
  options.object_angle = 0;  // a disc may find a point of a low object angle instead of the other one
  options.samples = 6;
  const PublishedAxis found = find_plane_axis_as_published(shape, options).value();
  EXPECT_NEAR(found.missed_angle, (std::numbers::pi / 6 + std::asin(0.75)) / 2, 1e-12);
  const PlaneAxis axis = find_plane_axis(shape, {}).value();
  const double largest = shape.report.longest_side() / 50;
  int checked = 0;
  for (const AxisArc& arc : axis.arcs) {
    for (int i = 0; i <= 8; ++i) {
      const double t = arc.t[0] + (arc.t[1] - arc.t[0]) * i / 8;
      if (arc.curve.object_angle_at(t) <= found.missed_angle || arc.curve.radius_at(t) < found.missed_radius) continue;
      const PlanePoint p = arc.curve.point_at(t);
      double nearest = std::numeric_limits<double>::infinity();
      for (const PublishedPoint& q : found.points) nearest = std::min(nearest, between(p, q.point));
      EXPECT_LE(nearest, 2 * largest);
      ++checked;
    }
  }
  EXPECT_GT(checked, 10);
}

INSTANTIATE_TEST_SUITE_P(Families, PublishedAxisTest, testing::Range(0u, test::kShapeFamilies),
                         [](const auto& family) { return test::family_name(family.param); });

TEST(PublishedAxis, TakesTheSamplesThatTheObjectAngleNeeds) {
  const PreparedShape shape = shape_of(0, 1);
  PlaneThesisOptions options;
  for (const double angle : {1.0, 0.6, 0.3, 0.1}) {
    options.object_angle = angle;
    const PublishedAxis found = find_plane_axis_as_published(shape, options).value();
    EXPECT_LE(found.missed_angle, angle);
    EXPECT_GE(found.samples, 6u);
  }
  options.object_angle = 0.6;
  EXPECT_EQ(find_plane_axis_as_published(shape, options).value().samples, 7u);
}

TEST(PublishedAxis, DoesNotDependOnThreads) {
  const PreparedShape shape = shape_of(3, 4);
  PlaneThesisOptions options;
  options.threads = 1;
  const PublishedAxis one = find_plane_axis_as_published(shape, options).value();
  options.threads = 3;
  const PublishedAxis three = find_plane_axis_as_published(shape, options).value();
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) EXPECT_EQ(one.points[i].point, three.points[i].point);
}

TEST(PublishedAxis, RefusesOptionsOutOfRange) {
  const PreparedShape shape = shape_of(0, 1);
  const auto code = [&](auto change) {
    PlaneThesisOptions options;
    change(options);
    return find_plane_axis_as_published(shape, options).error().code;
  };
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.object_angle = 2; }), ErrorCode::kUsage);
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.radius = -1; }), ErrorCode::kUsage);
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.samples = 5; }), ErrorCode::kUsage);
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.least_disc = 1e-9; }), ErrorCode::kUsage);
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.largest_disc = 1e-9; }), ErrorCode::kUsage);
  EXPECT_EQ(code([](PlaneThesisOptions& o) { o.epsilon = -1; }), ErrorCode::kUsage);
  EXPECT_EQ(find_plane_axis_as_published({}, {}).error().code, ErrorCode::kInvalidMesh);
}

TEST(PublishedAxis, StopsOnRequest) {
  std::stop_source stop;
  const auto at_once = [&](double) { stop.request_stop(); };
  const Result<PublishedAxis> result = find_plane_axis_as_published(shape_of(0, 1), {}, at_once, stop.get_token());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
