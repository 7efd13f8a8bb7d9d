// The axis in the plane against brute force: every point of it is equally far from two contacts and from nothing less,
// and no point of the exact axis is missed.
#include <gtest/gtest.h>

#include <cmath>

#include "support/plane_axis/exact_distances.h"
#include "support/plane_axis/ring_shapes.h"

namespace medial_vk::test {
namespace {

PlaneAxis axis_of(const PreparedShape& shape, const PlaneAxisOptions& options) {
  Result<PlaneAxis> axis = find_plane_axis(shape, options);
  EXPECT_TRUE(axis.ok()) << (axis.ok() ? "" : axis.error().message);
  return axis.ok() ? std::move(axis.value()) : PlaneAxis();
}

void expect_exact(const PreparedShape& shape, const PlaneAxis& axis, bool is_inner) {
  const double size = shape.report.longest_side();
  for (const AxisArc& arc : axis.arcs) {
    for (const double share : {0.1, 0.5, 0.9}) {
      const double t = arc.t[0] + share * (arc.t[1] - arc.t[0]);
      const PlanePoint x = arc.curve.point_at(t);
      const double radius = arc.curve.radius_at(t);
      // Rounding of coordinates up to three times as far from the origin as the shape is long.
      EXPECT_NEAR(nearest_point(shape, x).distance, radius, 1e-13 * size);
      if (radius > 1e-9 * size) {
        EXPECT_EQ(is_inside(shape, x), is_inner);
      }
    }
  }
}

void expect_complete(const PreparedShape& shape, const PlaneAxis& axis, const PlaneAxisOptions& options,
                     std::uint64_t seed, int samples) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < samples; ++i) {
    const auto sample = axis_sample(shape, options.side, random);
    // A turn of 0.04 or less can be one from a corner to its neighbourhood, at the resolution of a bisection.
    if (!sample || sample->object_angle < std::max(1.05 * options.object_angle, 0.02)) continue;
    EXPECT_LE(distance_to_axis(axis, sample->point), axis.epsilon) << sample->point[0] << ' ' << sample->point[1];
  }
}

class ExactAxis : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ExactAxis, IsMetAndIsAllThereIs) {
  for (std::uint64_t seed = 100 * GetParam(); seed < 100 * GetParam() + 28; ++seed) {
    SCOPED_TRACE(seed);
    const FillRule rule = seed % 2 == 0 ? FillRule::kEvenOdd : FillRule::kNonZero;
    const PreparedShape shape = prepared(rings_of_seed(seed), rule);
    for (const double angle : {0.0, 0.6}) {
      PlaneAxisOptions options;
      options.object_angle = angle;
      options.threads = 1;
      const PlaneAxis axis = axis_of(shape, options);
      expect_exact(shape, axis, true);
      expect_complete(shape, axis, options, seed, 40);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, ExactAxis, testing::Range(std::uint64_t{1}, std::uint64_t{5}));

TEST(ExactAxis, IsFoundAtAnyScale) {
  for (const double scale : {1e-9, 1e9}) {
    for (std::uint64_t seed = 0; seed < 28; ++seed) {
      SCOPED_TRACE(seed);
      const PreparedShape shape = prepared(rings_of_seed(seed, scale), FillRule::kEvenOdd);
      PlaneAxisOptions options;
      options.object_angle = 0.3;
      options.threads = 1;
      const PlaneAxis axis = axis_of(shape, options);
      expect_exact(shape, axis, true);
      expect_complete(shape, axis, options, seed, 20);
    }
  }
}

TEST(ExactAxis, IsFoundOutside) {
  for (std::uint64_t seed = 0; seed < 28; ++seed) {
    SCOPED_TRACE(seed);
    const PreparedShape shape = prepared(rings_of_seed(seed));
    PlaneAxisOptions options;
    options.side = PlaneSide::kOutside;
    options.object_angle = 0.3;
    options.threads = 1;
    const PlaneAxis axis = axis_of(shape, options);
    expect_exact(shape, axis, false);
    expect_complete(shape, axis, options, seed, 40);
  }
}

TEST(ExactAxis, DoesNotDependOnThreads) {
  const PreparedShape shape = prepared(square_with_holes(150, 4), FillRule::kEvenOdd);
  PlaneAxisOptions options;
  options.threads = 1;
  const PlaneAxis one = axis_of(shape, options);
  options.threads = 5;
  const PlaneAxis five = axis_of(shape, options);
  ASSERT_EQ(one.nodes.size(), five.nodes.size());
  ASSERT_EQ(one.arcs.size(), five.arcs.size());
  for (std::size_t i = 0; i < one.nodes.size(); ++i) EXPECT_EQ(one.nodes[i].point, five.nodes[i].point);
  for (std::size_t i = 0; i < one.arcs.size(); ++i) EXPECT_EQ(one.arcs[i].nodes, five.arcs[i].nodes);
}

/// Around each hole goes one loop, so by Euler's formula arcs and nodes differ by one less than the holes.
TEST(ExactAxis, IsConnectedAsTheShapeIs) {
  for (const int holes : {1, 7, 40}) {
    PlaneAxisOptions options;
    options.object_angle = 0;
    const PlaneAxis axis = axis_of(prepared(square_with_holes(holes, 9), FillRule::kEvenOdd), options);
    EXPECT_EQ(axis.arcs.size() + 1, axis.nodes.size() + static_cast<std::size_t>(holes));
  }
}

}  // namespace
}  // namespace medial_vk::test
