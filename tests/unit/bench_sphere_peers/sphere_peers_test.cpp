// The methods of bench/sphere_peers: each keeps what it promises, and measures of known balls are right.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "../../../bench/sphere_peers/k_means.h"
#include "../../../bench/sphere_peers/peers.h"
#include "../../../bench/sphere_peers/polygon.h"
#include "../../../bench/sphere_peers/samples.h"
#include "../../../bench/sphere_peers/voronoi_vertices.h"
#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_proofs.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk::bench {
namespace {

Solid solid_of(const Mesh& mesh) { return Solid::build(test::indexed(prepare_mesh(mesh).value())).value(); }

PeerOptions few_balls(std::size_t count, unsigned threads) {
  PeerOptions options;
  options.count = count;
  options.threads = threads;
  options.descent.steps = 110;  // balls are removed and added after 100
  options.descent.inside_points = 800;
  options.descent.boundary_points = 500;
  options.set_cover.candidates = 500;
  options.set_cover.samples = 300;
  options.k_means.samples = 2000;
  return options;
}

void expect_promise(const PeerMethod& method, const Solid& solid, const std::vector<Ball>& balls, std::size_t count) {
  SCOPED_TRACE(method.name);
  ASSERT_FALSE(balls.empty());
  EXPECT_LE(balls.size(), count);
  const SphereProofs proofs = prove_spheres(solid.indexed(), balls, balls).value();
  EXPECT_TRUE(method.promise != PeerPromise::kInside || proofs.inside.proved());
  EXPECT_TRUE(method.promise != PeerPromise::kCover || proofs.cover.proved());
  // Without any balls the volumes would differ by that of the solid.
  const double volume = measure_ball_union(balls).value().volume;
  EXPECT_TRUE(method.promise != PeerPromise::kNone || std::fabs(volume - solid.volume()) < solid.volume());
}

TEST(SpherePeers, KeepTheirPromises) {
  for (const Mesh& mesh : {test::make_turned_torus(40, 20), test::make_l_shape(2, 0.6, 0.8)}) {
    const Solid solid = solid_of(mesh);
    for (const PeerMethod& method : peer_methods()) {
      for (const std::size_t count : {15u, 40u}) {
        expect_promise(method, solid, method.fit(solid, few_balls(count, 2)), count);
      }
    }
  }
}

TEST(SpherePeers, DoNotDependOnThreads) {
  const Solid solid = solid_of(test::make_turned_torus(40, 20));
  for (const PeerMethod& method : peer_methods()) {
    SCOPED_TRACE(method.name);
    const std::vector<Ball> one = method.fit(solid, few_balls(20, 1)), three = method.fit(solid, few_balls(20, 3));
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].centre, three[i].centre);
      EXPECT_EQ(one[i].radius, three[i].radius);
    }
  }
}

/// The bounds of distances are apart by the tolerance of measure_spheres(), 2e-4 of the diagonal: 0.02 %, and balls
/// differ by 1e-12 from those of the formulas.
constexpr double kDistanceTolerance = 0.02 + 1e-9;

TEST(SpherePeers, MeasuresOfABallInACubeAreRight) {
  const Solid cube = solid_of(test::make_box({1, 1, 1}));
  const Point middle = 0.5 * (cube.mesh().report.lower + cube.mesh().report.upper);
  const double diagonal = std::sqrt(3.0), pi = std::numbers::pi;

  // The ball touches the faces, and leaves the corners.
  const PeerMeasures inside = measure_peer(cube, std::vector<Ball>{{middle, 0.5 - 1e-12}}, 1);
  EXPECT_TRUE(inside.is_inside);
  EXPECT_FALSE(inside.is_cover);
  EXPECT_NEAR(inside.uncovered, 100 * (1 - pi / 6), 1e-8);
  EXPECT_EQ(inside.added, 0);
  EXPECT_EQ(inside.protrusion, 0);
  EXPECT_NEAR(inside.hausdorff, 100 * (diagonal / 2 - 0.5) / diagonal, kDistanceTolerance);

  // The ball passes through the corners, and reaches out over the middles of faces.
  const PeerMeasures cover = measure_peer(cube, std::vector<Ball>{{middle, diagonal / 2 + 1e-12}}, 1);
  EXPECT_TRUE(cover.is_cover);
  EXPECT_FALSE(cover.is_inside);
  EXPECT_EQ(cover.uncovered, 0);
  EXPECT_NEAR(cover.added, 100 * (4 * pi / 3 * std::pow(diagonal / 2, 3) - 1), 1e-8);
  EXPECT_NEAR(cover.protrusion, 100 * (diagonal / 2 - 0.5) / diagonal, kDistanceTolerance);

  // Six caps of height 0.1 are outside. The standard error is that of the sum of two equal errors; 2.5 of it are five
  // of each.
  const double cap = pi * 0.1 * 0.1 * (3 * 0.6 - 0.1) / 3, ball = 4 * pi / 3 * 0.6 * 0.6 * 0.6;
  const PeerMeasures both = measure_peer(cube, std::vector<Ball>{{middle, 0.6}}, 1);
  EXPECT_FALSE(both.is_inside || both.is_cover);
  EXPECT_GT(both.standard_error, 0);
  EXPECT_NEAR(both.added, 100 * 6 * cap, 2.5 * both.standard_error);
  EXPECT_NEAR(both.uncovered, 100 * (1 - ball + 6 * cap), 2.5 * both.standard_error);
  EXPECT_NEAR(both.protrusion, 100 * 0.1 / diagonal, kDistanceTolerance);
}

TEST(SpherePeers, CellsOfACubeHaveTheSmallestBalls) {
  const Solid cube = solid_of(test::make_box({1, 1, 1}));
  const Point lower = cube.mesh().report.lower;
  // The cells of the middles of eight smaller cubes are these cubes.
  std::vector<Point> centres;
  for (const double x : {0.25, 0.75}) {
    for (const double y : {0.25, 0.75}) {
      for (const double z : {0.25, 0.75}) centres.push_back(lower + Point{x, y, z});
    }
  }
  const std::vector<Ball> balls = smallest_around_cells(cube, centres, 1);
  ASSERT_EQ(balls.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    // Radii are enlarged by 1e-7 of the diagonal, and smallest_ball() has a relative error e of at most 1e-10. Where a
    // ball of radius R (1 + e) holds the corners of a cube, its centre is at most R sqrt(2 e + e^2) from the cube's.
    EXPECT_NEAR(balls[i].radius, std::sqrt(3.0) * (0.25 + 1e-7), 1e-10);
    EXPECT_LT(length(balls[i].centre - centres[i]), 0.44 * 1.5e-5);
  }
}

TEST(SpherePeers, VoxelsOfACubeAreItsCells) {
  const Solid cube = solid_of(test::make_box({1, 1, 1}));
  for (const PeerMethod& method : peer_methods()) {
    if (method.name != std::string("voxel-cover")) continue;
    const std::vector<Ball> balls = method.fit(cube, few_balls(27, 1));
    ASSERT_EQ(balls.size(), 27u);
    // Radii are enlarged by a millionth.
    for (const Ball& ball : balls) EXPECT_NEAR(ball.radius, std::sqrt(3.0) / 6 * (1 + 1e-6), 1e-14);
    EXPECT_TRUE(prove_spheres(cube.indexed(), {}, balls).value().cover.proved());
  }
}

TEST(SpherePeers, PolygonsMeetBoxes) {
  const Point lower = {0, 0, 0}, upper = {1, 1, 1};
  EXPECT_TRUE(meets_box({{{-1, 0.5, 0.5}, {2, 0.5, 0.5}, {2, 0.6, 0.5}}}, lower, upper));
  EXPECT_TRUE(meets_box({{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}}}, lower, upper));  // a common corner
  // Their boxes meet, but x + y >= 2.1 on the triangle.
  EXPECT_FALSE(meets_box({{{2.1, 0, 0}, {0, 2.1, 0}, {2.1, 2.1, 1}}}, lower, upper));
}

TEST(SpherePeers, VoronoiVerticesAreEquallyFarFromTheirPoints) {
  const Solid solid = solid_of(test::make_l_shape(2, 0.6, 0.8));
  const std::vector<Point> points = points_inside(solid, 200, 7, 1);
  const std::vector<VoronoiVertex> vertices = voronoi_vertices(points, 1);
  ASSERT_GT(vertices.size(), 200u);
  for (const VoronoiVertex& vertex : vertices) {
    const double radius = length(vertex.at - points[vertex.points[0]]);
    // Both distances have the error of the vertex, and some roundings of these coordinates and squares.
    const double rounding = 2 * vertex.slack + 1e-14 * (4 + radius);
    for (const std::uint32_t p : vertex.points) EXPECT_NEAR(length(vertex.at - points[p]), radius, rounding);
    for (const Point& p : points) EXPECT_GE(length(vertex.at - p), radius - rounding);
  }
}

}  // namespace
}  // namespace medial_vk::bench
