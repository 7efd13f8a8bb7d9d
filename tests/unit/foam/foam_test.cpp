// The foam's parts where the result is known: polytopes, hulls, the two boundary points of Figure 3-1, wrong usage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "foam/clip_polytope.h"
#include "medial_vk/foam.h"

namespace medial_vk {
namespace {

TEST(ClipPolytope, CutsACornerOffACube) {
  ClipPolytope cube(1);
  const double third = 1 / std::sqrt(3);
  cube.clip({{third, third, third}, 2 * third}, 7,
            0);  // x + y + z <= 2: through three edges at distance 1 from a corner
  ASSERT_EQ(cube.vertices().size(), 10u);
  int made = 0;
  for (const auto& v : cube.vertices()) {
    if (std::count(v.planes.begin(), v.planes.end(), 7) == 0) continue;
    ++made;
    EXPECT_NEAR(v.position[0] + v.position[1] + v.position[2], 2, 1e-15);
  }
  EXPECT_EQ(made, 3);
}

TEST(ClipPolytope, KeepsFacesThatACutTouchesAndMayVanish) {
  ClipPolytope cube(1);
  cube.clip({{1, 0, 0}, 1}, 1, 0);
  EXPECT_EQ(cube.vertices().size(), 8u);
  cube.clip({{1, 0, 0}, -2}, 2, 0);
  EXPECT_TRUE(cube.empty());
}

// Planes that nearly coincide or meet in one point, where the signs of rounded heights contradict each other: the
// polytope must keep every point that is in all half-spaces, and nothing far from it.
TEST(ClipPolytope, SurvivesDegenerateCuts) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    ClipPolytope polytope(2);
    std::vector<HalfSpace> cuts;
    const Point apex = {0.3, -0.2, 0.1};
    for (int k = 0; k < 60; ++k) {
      Point n = {normal(engine), normal(engine), normal(engine)};
      if (k % 3 == 1) n = cuts.back().normal + 1e-15 * n;  // the last one again
      n = (1 / length(n)) * n;
      if (dot(n, apex) < 0) n = -1.0 * n;
      cuts.push_back({n, dot(n, apex)});  // all through one point: a cone that holds the origin
      polytope.clip(cuts.back(), k, 0x1p-40);
    }
    ASSERT_FALSE(polytope.empty());
    double nearest_to_apex = 9;
    for (const auto& v : polytope.vertices()) {
      nearest_to_apex = std::min(nearest_to_apex, length(v.position - apex));
      for (const HalfSpace& h : cuts) EXPECT_LE(dot(h.normal, v.position), h.offset + 1e-9);
    }
    EXPECT_LT(nearest_to_apex, 1e-9);
    // Support in random directions is never below that of the points of the cone.
    for (int k = 0; k < 50; ++k) {
      const Point n = {normal(engine), normal(engine), normal(engine)};
      double support = -9;
      for (const auto& v : polytope.vertices()) support = std::max(support, dot(n, v.position));
      EXPECT_GE(support, std::max(0.0, dot(n, apex)) - 1e-12);
    }
  }
}

TEST(HullHalfSpaces, OfACubeAreItsFaces) {
  std::vector<Point> corners;
  for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.});
  for (const HalfSpace& h : hull_half_spaces(corners, std::sqrt(3.0))) {
    const double largest = std::max({std::abs(h.normal[0]), std::abs(h.normal[1]), std::abs(h.normal[2])});
    EXPECT_NEAR(largest, 1, 1e-9);
    EXPECT_NEAR(h.offset, 1, 1e-9);
  }
}

/// Nearest of a few points.
NearestPointsFunction nearest_of(const std::vector<Point>& sites) {
  return [sites](std::span<const Point> queries) -> Result<std::vector<Point>> {
    std::vector<Point> out;
    out.reserve(queries.size());
    for (const Point& q : queries) {
      const auto closer = [&](const Point& a, const Point& b) { return length(a - q) < length(b - q); };
      out.push_back(*std::min_element(sites.begin(), sites.end(), closer));
    }
    return out;
  };
}

// Figure 3-1: two boundary points on both sides of a sphere, whose medial plane runs through the centre.
TEST(SphereSamples, DeepSamplesSeeTheMedialPlaneOfFigure31) {
  const Ball sphere = {{0, 0, 0}, 1};
  const auto nearest = nearest_of({{0.05, 1.5, 0}, {0, -1.6, 0}});
  const SphereSamplingOptions blind = {.count = 2, .deep_samples = false};  // both poles: their lines are short
  const auto without = sample_sphere(sphere, blind, nearest);
  ASSERT_TRUE(without.ok());
  EXPECT_FALSE(without.value().holds_medial_point);
  const auto with = sample_sphere(sphere, {.count = 2}, nearest);
  ASSERT_TRUE(with.ok());
  EXPECT_TRUE(with.value().holds_medial_point);
}

// One boundary point far below: no medial point; the foam of the one site is the hull's vertices, all of type 1.
TEST(Foam, OfOneSiteHasBallsOfTypeOneOnly) {
  const Ball sphere = sphere_around_voxel({1, 2, 3}, 0.5);
  EXPECT_DOUBLE_EQ(sphere.radius, std::sqrt(3.0) / 4);
  const auto samples = sample_sphere(sphere, {.count = 20}, nearest_of({{1, 2, 0}}));
  ASSERT_TRUE(samples.ok());
  EXPECT_FALSE(samples.value().holds_medial_point);
  const auto foam = Foam::build(samples.value().samples, sphere);
  ASSERT_TRUE(foam.ok());
  EXPECT_EQ(foam.value().sites().size(), 1u);
  EXPECT_EQ(foam.value().empty_balls().size(), samples.value().samples.size());
  for (const FoamBall& ball : foam.value().full_balls()) {
    EXPECT_EQ(ball.kind, FoamBallKind::kHullVertex);
    EXPECT_EQ(ball.sites[0], 0u);
    EXPECT_EQ(ball.sites[1], FoamBall::kNoSite);
  }
  EXPECT_TRUE(foam.value().may_hold_contact({1, 2, 0}));
  EXPECT_FALSE(foam.value().may_hold_contact({1, 2, 3}));   // in an empty ball
  EXPECT_FALSE(foam.value().may_hold_contact({1, 2, -5}));  // beyond the full foam
}

// Above one plane there is no medial point; the bounds depend only on the samples.
TEST(Foam, BoundsAreSmallAboveAPlane) {
  const Ball sphere = {{0.1, 0.2, 3}, 1};
  const NearestPointsFunction plane = [](std::span<const Point> queries) -> Result<std::vector<Point>> {
    std::vector<Point> out;
    out.reserve(queries.size());
    for (const Point& q : queries) out.push_back({q[0], q[1], 0});
    return out;
  };
  double depth = sphere.radius;
  for (const std::uint32_t count : {12u, 24u, 48u}) {
    const auto samples = sample_sphere(sphere, {.count = count}, plane);
    ASSERT_TRUE(samples.ok());
    EXPECT_FALSE(samples.value().holds_medial_point);
    const auto foam = Foam::build(samples.value().samples, sphere);
    ASSERT_TRUE(foam.ok());
    depth = foam.value().depth_bound(2);
    std::cout << count << " points: depth bound " << depth << ", uncovered " << foam.value().uncovered_depth()
              << ", width at a quarter " << foam.value().width_bound(0.25) << '\n';
  }
  EXPECT_LT(depth, 0.15);  // 0.11 when this was written; the bound without a foam is the radius
}

TEST(Foam, NamesWrongUsage) {
  const Ball sphere = {{0, 0, 0}, 1};
  const double nan = std::nan("");
  const std::vector<FoamSample> good = {{{0, 0, 1}, {0, 0, 2}}},
                                outside = {{{0, 0, 1}, {0, 0, 2}}, {{0, 0, 2}, {0, 0, 3}}},
                                not_finite = {{{0, nan, 1}, {0, 0, 2}}};
  EXPECT_TRUE(Foam::build(good, sphere).ok());
  for (const auto& bad : {Foam::build({}, sphere), Foam::build(good, {{0, 0, 0}, 0}), Foam::build(good, sphere, -1),
                          Foam::build(outside, sphere), Foam::build(not_finite, sphere)}) {
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().code, ErrorCode::kUsage);
  }
  EXPECT_EQ(Foam::build(outside, sphere).error().message, "foam: sample 1 lies outside the sphere");
}

TEST(SphereSamples, PassOnErrorsOfTheCallback) {
  const Ball sphere = {{0, 0, 0}, 1};
  const NearestPointsFunction fails = [](std::span<const Point>) -> Result<std::vector<Point>> {
    return Error{ErrorCode::kOutOfMemory, "no more"};
  };
  const NearestPointsFunction forgets = [](std::span<const Point>) -> Result<std::vector<Point>> {
    return std::vector<Point>{};
  };
  EXPECT_EQ(sample_sphere(sphere, {}, fails).error().message, "no more");
  EXPECT_EQ(sample_sphere(sphere, {}, forgets).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
