// Unions measured one after the other in the same memory are those of measure_ball_union(), to the bit.
#include "ball_unions/unions/union_measurer.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "medial_vk/ball_union.h"
#include "support/solids/ball_families.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

void expect_equal_unions(const BallUnion& a, const BallUnion& b) {
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.volumes, b.volumes);
  EXPECT_EQ(a.areas, b.areas);
  EXPECT_EQ(a.vectors, b.vectors);
  EXPECT_EQ(a.complex.vertices, b.complex.vertices);
  EXPECT_EQ(a.complex.edges, b.complex.edges);
  EXPECT_EQ(a.complex.triangles, b.complex.triangles);
  EXPECT_EQ(a.complex.tetrahedra, b.complex.tetrahedra);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_EQ(a.vertices[i].at, b.vertices[i].at);
    EXPECT_EQ(a.vertices[i].balls, b.vertices[i].balls);
  }
}

/// Two rods that pass each other: n^2 / 4 tetrahedra, so that each ball is measured by itself.
std::vector<Ball> two_rods(int n) {
  std::vector<Ball> balls;
  for (int i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / n;
    balls.push_back({{t, 0, 0}, 0.02});
    balls.push_back({{0.5, t - 0.5, 1}, 0.02});
  }
  return balls;
}

// Many after few and few after many, degenerate ones that need exact arithmetic, and those without a triangulation.
TEST(UnionMeasurer, EqualsSingleMeasurements) {
  const std::vector<std::vector<Ball>> sets = {test::random_balls(700, 1, 0.05, 0.3),
                                               test::lattice(5, 0.6),
                                               {},
                                               test::random_balls(3000, 2, 0.02, 0.1),
                                               two_rods(600),
                                               test::through_a_point(60, 3, true),
                                               {{{0, 0, 0}, 1}},
                                               test::cospherical(200, 0.4),
                                               test::random_balls(700, 1, 0.05, 0.3)};
  for (const unsigned threads : {1u, 3u}) {
    WorkerPool pool(threads);
    UnionMeasurer measurer;
    for (const bool complex : {false, true, false}) {
      for (std::size_t i = 0; i < sets.size(); ++i) {
        SCOPED_TRACE(i);
        ASSERT_TRUE(measurer.measure(sets[i], complex, pool).ok());
        expect_equal_unions(measurer.result(), measure_ball_union(sets[i], {1, complex}).value());
      }
    }
  }
}

TEST(UnionMeasurer, GoesOnAfterAnError) {
  WorkerPool pool(1);
  UnionMeasurer measurer;
  const std::vector<Ball> good = test::random_balls(50, 1, 0.1, 0.3);
  const std::vector<Ball> bad = {{{0, 0, 0}, std::numeric_limits<double>::infinity()}};
  EXPECT_FALSE(measurer.measure(bad, false, pool).ok());
  ASSERT_TRUE(measurer.measure(good, false, pool).ok());
  expect_equal_unions(measurer.result(), measure_ball_union(good).value());
}

}  // namespace
}  // namespace medial_vk
