// The thinnest wall: solids with known walls.
#include "medial_vk/least_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stop_token>
#include <string>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "medial_vk/prepare.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"
#include "unit/least_wall/wall_examples.h"

namespace medial_vk::test {
namespace {

IndexedMesh whole_of(const Mesh& mesh) { return indexed(prepare_mesh(mesh).value()); }

LeastWall least_wall_of(const IndexedMesh& mesh, const LeastWallOptions& options = {}) {
  return measure_least_wall(mesh, options).value();
}

/// A prism over the triangle with the apex at the origin and two sides of length 1 at an angle.
Mesh make_wedge(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {.vertices = {{0, 0, 0}, {1, 0, 0}, {c, s, 0}, {0, 0, 1}, {1, 0, 1}, {c, s, 1}},
          .triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

/// A prism over an equilateral triangle with sides of length 1, of the length 2. Each side is a fan of this number of
/// triangles around its middle, which is even and at least 4.
Mesh make_fanned_prism(std::uint32_t triangles) {
  const std::uint32_t parts = (triangles - 2) / 2, of_edge = parts + 1;  // of a long edge; its vertices
  Mesh mesh;
  for (const Point& corner : {Point{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}) {
    for (std::uint32_t i = 0; i <= parts; ++i) mesh.vertices.push_back(corner + Point{0, 0, 2.0 * i / parts});
  }
  mesh.triangles = {{0, 2 * of_edge, of_edge}, {parts, of_edge + parts, 2 * of_edge + parts}};
  for (std::uint32_t side = 0; side < 3; ++side) {
    const std::uint32_t here = side * of_edge, next = (side + 1) % 3 * of_edge;
    const auto apex = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.5 * (mesh.vertices[here] + mesh.vertices[next + parts]));
    mesh.triangles.push_back({apex, here, next});
    mesh.triangles.push_back({apex, next + parts, here + parts});
    for (std::uint32_t i = 0; i < parts; ++i) {
      mesh.triangles.push_back({apex, next + i, next + i + 1});
      mesh.triangles.push_back({apex, here + i + 1, here + i});
    }
  }
  return mesh;
}

// Rounding of coordinates turns or moves faces by some 2^-52 of the side.
void expect_wall(const LeastWall& found, double wall, double width = 0.01) {
  EXPECT_LE(found.diameter.lower, wall * (1 + 1e-12));
  EXPECT_GE(found.diameter.upper, wall * (1 - 1e-12));
  EXPECT_LE(found.diameter.upper, found.diameter.lower * (1 + width) * (1 + 1e-12));
}

TEST(LeastWall, OfATurnedPlate) {
  const IndexedMesh mesh = whole_of(turned(make_box({1, 0.02, 0.5})));
  const LeastWallOptions options;
  const LeastWall found = least_wall_of(mesh, options);
  expect_wall(found, 0.02);
  expect_touches(found, mesh.prepared(), options);
  EXPECT_NEAR(length(found.thinnest->a - found.thinnest->b), 0.02, 1e-12);
  EXPECT_NEAR(found.thinnest->object_angle, std::numbers::pi / 2, 1e-5);
}

// Balls at edges and corners with right angles have object angles of pi / 4 and less.
TEST(LeastWall, OfACubeIsItsSide) {
  expect_wall(least_wall_of(whole_of(make_box({1, 1, 1}))), 1);
  // The ball is isolated, and turned faces have no computed point that is exactly in their middle: it is not found.
  const Bounds diameter = least_wall_of(whole_of(turned(make_box({1, 1, 1})))).diameter;
  EXPECT_LE(diameter.lower, 1 + 1e-12);
  EXPECT_GE(diameter.lower, 1 / 1.01);
  EXPECT_GE(diameter.upper, 1);
}

// The wall of a cup of n segments is thinnest between the middles of parallel facets.
TEST(LeastWall, OfACup) {
  const IndexedMesh mesh = whole_of(turned(make_cup(0.5, 0.1, 0.4, 12)));
  const LeastWallOptions options = width_of(0.04);
  const LeastWall found = least_wall_of(mesh, options);
  expect_wall(found, 0.1 * std::cos(std::numbers::pi / 12), options.width);
  expect_touches(found, mesh.prepared(), options);
}

// Between the spheres of radius 0.7 and 1. No chord of a facet is farther from the sphere than its plane.
TEST(LeastWall, OfAShell) {
  const IndexedMesh mesh = whole_of(make_shell(720, 180));
  const LeastWallOptions options = width_of(0.05);
  const LeastWall found = least_wall_of(mesh, options);
  expect_touches(found, mesh.prepared(), options);
  const reference::Tree tree(to_reference(mesh.prepared()));
  double inner = 1;  // the distance of the outer facets from the centre
  for (int t = 0; t < tree.triangle_count(); ++t) {
    if (tree.corner(t, 0).norm() < 0.9) continue;
    inner = std::min(inner, std::sqrt(tree.closest_on(t, Eigen::Vector3d::Zero()).squared_distance));
  }
  EXPECT_LE(found.diameter.lower, 0.3);
  EXPECT_GE(found.diameter.upper, inner - 0.7);
  EXPECT_LE(found.diameter.upper, found.diameter.lower * 1.05 * (1 + 1e-12));
}

// The faces of an edge of 20 degrees are walls down to no thickness; the object angle there is 80 degrees.
TEST(LeastWall, OfASharpEdgeIsNothing) {
  const LeastWall found = least_wall_of(whole_of(turned(make_wedge(std::numbers::pi / 9))));
  EXPECT_GE(found.diameter.lower, 0);
  EXPECT_LE(found.diameter.lower, 1e-6);
  EXPECT_LE(found.diameter.upper, 1e-3);
}

// A prism over an equilateral triangle: balls along its edges have an object angle of pi / 3, less than 1.2. The limit
// leaves out the balls that touch all three sides, of diameter 0.577.
TEST(LeastWall, LeavesOutBluntEdges) {
  const IndexedMesh mesh = whole_of(turned(make_wedge(std::numbers::pi / 3)));
  LeastWallOptions options;
  options.limit = 0.5;
  const LeastWall found = least_wall_of(mesh, options);
  EXPECT_GE(found.diameter.lower, 0.5 / 1.01);
  EXPECT_FALSE(found.thinnest);
  options.object_angle = 1;  // less than pi / 3
  EXPECT_LE(least_wall_of(mesh, options).diameter.lower, 1e-6);
}

// The balls that touch all three sides of that prism have contacts at 120 degrees, less than 2 theta, and those that
// touch both ends do not fit between the sides: there is no wall.
TEST(LeastWall, LeavesOutSeamsOfThreeSheets) {
  const IndexedMesh mesh = whole_of(turned(make_wedge(std::numbers::pi / 3)));
  LeastWallOptions options;
  options.limit = 0.9;
  const LeastWall found = least_wall_of(mesh, options);
  EXPECT_GE(found.diameter.lower, 0.9 / 1.01);
  EXPECT_FALSE(found.thinnest);
}

// The ball that touches all three sides is near all triangles of three fans, at every size of a cell.
TEST(LeastWall, LeavesOutSeamsOfThreeFans) {
  const IndexedMesh mesh = whole_of(turned(make_fanned_prism(16)));
  LeastWallOptions options;
  options.limit = 0.9;
  options.cells = 100'000;  // seven times as many as it takes
  const LeastWall found = least_wall_of(mesh, options);
  EXPECT_GE(found.diameter.lower, 0.9 / 1.01);
  EXPECT_FALSE(found.thinnest);
}

TEST(LeastWall, OfAGap) {
  const IndexedMesh mesh = whole_of(make_turned_gap(0.03));
  LeastWallOptions options = width_of(0.05);
  options.side = ThicknessSide::kGaps;
  const LeastWall found = least_wall_of(mesh, options);
  expect_wall(found, 0.03, options.width);
  expect_touches(found, mesh.prepared(), options);
  expect_wall(least_wall_of(mesh), 0.2);
}

TEST(LeastWall, EndsAtItsLimit) {
  const IndexedMesh mesh = whole_of(turned(make_box({1, 0.1, 0.5})));
  LeastWallOptions options;
  options.limit = 0.05;
  const LeastWall none = least_wall_of(mesh, options);
  EXPECT_FALSE(none.thinnest);
  EXPECT_LE(none.diameter.lower, 0.05);
  EXPECT_GE(none.diameter.lower, 0.05 / 1.01);
  EXPECT_GE(none.diameter.upper, 0.05);
  options.limit = 0.2;
  expect_wall(least_wall_of(mesh, options), 0.1);
}

// Few cells leave an interval that is wider, and holds the wall all the same.
TEST(LeastWall, WithinABudget) {
  const IndexedMesh mesh = whole_of(turned(make_cup(0.5, 0.1, 0.4, 12)));
  LeastWallOptions few;
  few.cells = 2000;
  const LeastWall wide = least_wall_of(mesh, few), exact = least_wall_of(mesh, width_of(0.04));
  EXPECT_LE(wide.diameter.lower, exact.diameter.upper);
  EXPECT_GE(wide.diameter.upper, exact.diameter.lower);
  EXPECT_GT(wide.diameter.upper, wide.diameter.lower * 1.01);
  EXPECT_GT(exact.cells, wide.cells);
}

// Both intervals hold the same number.
TEST(LeastWall, IsThatOfATurnedMesh) {
  const Mesh mesh = bent(make_turned_torus(24, 16));
  const LeastWallOptions options = width_of(0.05);
  const LeastWall a = least_wall_of(whole_of(mesh), options), b = least_wall_of(whole_of(turned(mesh)), options);
  EXPECT_LE(a.diameter.lower, b.diameter.upper * (1 + 1e-12));
  EXPECT_LE(b.diameter.lower, a.diameter.upper * (1 + 1e-12));
}

TEST(LeastWall, DoesNotDependOnThreads) {
  const IndexedMesh mesh = whole_of(turned(make_box({1, 0.1, 0.5})));
  LeastWallOptions one = width_of(0.01), three = one;
  one.threads = 1;
  three.threads = 3;
  const LeastWall a = least_wall_of(mesh, one), b = least_wall_of(mesh, three);
  EXPECT_EQ(a.diameter.lower, b.diameter.lower);
  EXPECT_EQ(a.diameter.upper, b.diameter.upper);
  EXPECT_EQ(a.cells, b.cells);
  ASSERT_TRUE(a.thinnest && b.thinnest);
  EXPECT_EQ(a.thinnest->ball.centre, b.thinnest->ball.centre);
  EXPECT_EQ(a.thinnest->ball.radius, b.thinnest->ball.radius);
  EXPECT_EQ(a.thinnest->a, b.thinnest->a);
  EXPECT_EQ(a.thinnest->b, b.thinnest->b);
  EXPECT_EQ(a.thinnest->object_angle, b.thinnest->object_angle);
}

// Balls may touch such triangles from both sides; the interval is wider, and holds the wall all the same.
TEST(LeastWall, TrustsNoNormalWithoutItsFlag) {
  const Mesh box = turned(make_box({1, 0.1, 0.5}));
  const IndexedMesh mesh = indexed(view_of(box));
  LeastWallOptions options = width_of(0.1);
  options.cells = 100'000;
  const LeastWall found = least_wall_of(mesh, options);
  EXPECT_LE(found.diameter.lower, 0.1 * (1 + 1e-12));
  EXPECT_GE(found.diameter.upper, 0.1 * (1 - 1e-12));
}

TEST(LeastWall, RefusesWhatIsWrong) {
  const auto message_of = [](const IndexedMesh& mesh, const LeastWallOptions& options) {
    const auto found = measure_least_wall(mesh, options);
    if (found.ok()) return std::string();
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    return found.error().message;
  };
  const IndexedMesh mesh = whole_of(make_box({1, 1, 1}));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double angle : {0.78, 1.5708, kNan}) {
    LeastWallOptions options;
    options.object_angle = angle;
    EXPECT_EQ(message_of(mesh, options), "`object_angle` must be between pi / 4 and pi / 2");
  }
  for (const double width : {0.0, 1.5, kNan}) {
    EXPECT_EQ(message_of(mesh, width_of(width)), "`width` must be from 1e-6 to 1");
  }
  for (const double limit : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
    LeastWallOptions options;
    options.limit = limit;
    EXPECT_EQ(message_of(mesh, options), "`limit` must be a length, or 0");
  }
  LeastWallOptions options;
  options.cells = 0;
  EXPECT_EQ(message_of(mesh, options), "`cells` must be positive");
  Mesh open = make_box({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_EQ(message_of(whole_of(open), {}), "the least wall is proved for closed meshes alone");
  EXPECT_EQ(message_of(mesh, {}), "");
}

TEST(LeastWall, CanBeStopped) {
  const IndexedMesh mesh = whole_of(make_turned_torus(40, 24));
  std::stop_source source;
  double done = 0;
  const auto found = measure_least_wall(
      mesh, width_of(1e-6),
      [&](double share) {
        done = share;
        source.request_stop();
      },
      source.get_token());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kInterrupted);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 1);
}

}  // namespace
}  // namespace medial_vk::test
