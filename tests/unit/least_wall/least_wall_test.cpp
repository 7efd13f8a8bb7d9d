// The thinnest wall: solids with known walls, and the balls of the reference that shrink from many boundary points.
#include "medial_vk/least_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "least_wall/wall_cells.h"
#include "medial_vk/prepare.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

LeastWallOptions width_of(double width) {
  LeastWallOptions options;
  options.width = width;
  return options;
}

IndexedMesh whole_of(const Mesh& mesh) { return indexed(prepare_mesh(mesh).value()); }

LeastWall least_wall_of(const IndexedMesh& mesh, const LeastWallOptions& options = {}) {
  return measure_least_wall(mesh, options).value();
}

/// Turned, so that no face is parallel to the cells.
Mesh turned(Mesh mesh) {
  rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

/// A prism over the triangle with the apex at the origin and two sides of length 1 at an angle.
Mesh make_wedge(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {.vertices = {{0, 0, 0}, {1, 0, 0}, {c, s, 0}, {0, 0, 1}, {1, 0, 1}, {c, s, 1}},
          .triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

// Rounding of coordinates turns or moves faces by some 2^-52 of the side.
void expect_wall(const LeastWall& found, double wall, double width = 0.01) {
  EXPECT_LE(found.diameter.lower, wall * (1 + 1e-12));
  EXPECT_GE(found.diameter.upper, wall * (1 - 1e-12));
  EXPECT_LE(found.diameter.upper, found.diameter.lower * (1 + width) * (1 + 1e-12));
}

/// The ball of the upper end is empty, on its side, and touches in both contacts, by the reference.
void expect_touches(const LeastWall& found, const PreparedMesh& mesh, const LeastWallOptions& options) {
  ASSERT_TRUE(found.thinnest);
  const reference::Tree tree(to_reference(mesh));
  const auto& [ball, a, b, angle] = *found.thinnest;
  const double rounding = 1e-12 * mesh.report.longest_side();
  EXPECT_LE(found.diameter.lower, 2 * ball.radius);
  EXPECT_GE(found.diameter.upper, 2 * ball.radius);
  EXPECT_GE(tree.closest(to_eigen(ball.centre)).distance, ball.radius - rounding);
  EXPECT_EQ(reference::is_inside(tree, to_eigen(ball.centre)), options.side == ThicknessSide::kWalls);
  for (const Point& contact : {a, b}) {
    EXPECT_NEAR(length(contact - ball.centre), ball.radius, rounding);
    EXPECT_LE(tree.closest(to_eigen(contact)).distance, rounding);
  }
  const Point u = (1 / ball.radius) * (a - ball.centre), v = (1 / ball.radius) * (b - ball.centre);
  // The derivative of the angle by the positions of the contacts is at most 1 / (r sin of it).
  EXPECT_NEAR(reference::half_angle(to_eigen(u), to_eigen(v)), angle, 1e-6);
  EXPECT_GE(angle, options.object_angle - 0.001);
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

TEST(LeastWall, OfAGap) {
  Mesh both = make_box({0.3, 0.3, 0.2});
  append(both, moved(make_box({0.3, 0.3, 0.2}), {0.33, 0, 0}));
  const IndexedMesh mesh = whole_of(turned(both));
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

struct WallCase {
  const char* name;
  Mesh mesh;
  ThicknessSide side = ThicknessSide::kWalls;
};

std::vector<WallCase> wall_cases() {
  Mesh irregular = smooth_ellipsoid(1, 0.7, 0.2)->mesh(900);
  make_irregular(*smooth_ellipsoid(1, 0.7, 0.2), irregular, 5);
  return {{"ellipsoid", irregular},
          {"torus", make_turned_torus(30, 20)},
          {"L", turned(make_l_shape(1, 0.3, 0.2))},
          {"plate with a hole", turned(make_plate_with_hole(1, 0.1, 0.3))},
          {"bent torus", bent(make_turned_torus(24, 16))},
          {"bent cup", bent(turned(make_cup(0.5, 0.1, 1, 16)))},
          {"bent L outside", bent(turned(make_l_shape(1, 0.3, 0.2))), ThicknessSide::kGaps}};
}

/// The ball that is tangent at p, with its centre in this direction, and shrinks from a radius until it
/// holds no point of the mesh, if its object angle is no less than the given one.
std::optional<Ball> shrunk_ball(const reference::Tree& tree, const Eigen::Vector3d& p, const Eigen::Vector3d& direction,
                                double radius, double object_angle) {
  std::optional<Eigen::Vector3d> other;
  for (int step = 0; step < 60; ++step) {
    const Eigen::Vector3d centre = p + radius * direction;
    const reference::Closest closest = tree.closest(centre);
    if (closest.distance >= radius * (1 - 1e-9)) {
      if (!other) return std::nullopt;
      const Eigen::Vector3d a = (p - centre).normalized(), b = (*other - centre).normalized();
      return reference::half_angle(a, b) >= object_angle ? std::optional(Ball{to_point(centre), radius}) : std::nullopt;
    }
    const Eigen::Vector3d chord = closest.point - p;
    const double along = chord.dot(direction);
    if (!(along > 0)) return std::nullopt;
    other = closest.point;
    radius = chord.squaredNorm() / (2 * along);
  }
  return std::nullopt;
}

/// No cell of any size that holds the centre of a ball has a bound above its radius.
void expect_bounds_below(const IndexedMesh& mesh, const LeastWallOptions& options, const std::vector<Ball>& balls) {
  const Solid solid = Solid::build(mesh).value();
  const WideTree tree(solid.bvh());
  const std::vector<SpokeCone> normals = normals_of(solid);
  const WallField field = {solid, tree, normals, options};
  WallCells cells(field);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<> offset(-1, 1);
  for (const Ball& ball : balls) {
    for (int k = 0; k < 12; ++k) {
      WallCell cell = {.centre = ball.centre, .half = ball.radius * std::ldexp(1, 1 - k)};
      for (double& x : cell.centre) x += cell.half * offset(random);
      cells.examine(cell, std::numeric_limits<double>::infinity());
      EXPECT_LE(cell.least, ball.radius * (1 + 1e-8)) << k << " at " << testing::PrintToString(ball.centre);
    }
  }
}

class LeastWallOf : public testing::TestWithParam<WallCase> {};

TEST_P(LeastWallOf, HoldsWhatTheReferenceFinds) {
  const PreparedMesh prepared = prepare_mesh(GetParam().mesh).value();
  const reference::Tree tree(to_reference(prepared));
  LeastWallOptions options = width_of(0.05);
  options.side = GetParam().side;
  const LeastWall found = least_wall_of(indexed(prepared), options);
  EXPECT_LE(found.diameter.upper, found.diameter.lower * 1.05 * (1 + 1e-12));
  const double longest = prepared.report.longest_side(), toward = options.side == ThicknessSide::kWalls ? -1 : 1;
  if (found.thinnest) expect_touches(found, prepared, options);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> share(0, 1);
  std::vector<Ball> balls;
  for (int t = 0; t < tree.triangle_count(); ++t) {
    for (int i = 0; i < 4000 / tree.triangle_count() + 1; ++i) {
      const double a = std::sqrt(share(random)), b = share(random);
      const Eigen::Vector3d p =
          (1 - a) * tree.corner(t, 0) + a * (1 - b) * tree.corner(t, 1) + a * b * tree.corner(t, 2);
      const auto ball = shrunk_ball(tree, p, toward * tree.normal(t), 0.5 * longest, options.object_angle + 1e-6);
      if (ball) balls.push_back(*ball);
    }
  }
  for (const Ball& ball : balls) EXPECT_GE(2 * ball.radius, found.diameter.lower * (1 - 1e-8));
  expect_bounds_below(indexed(prepared), options, balls);
  if (options.side == ThicknessSide::kWalls) {
    EXPECT_GT(balls.size(), 10u);
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, LeastWallOf, testing::ValuesIn(wall_cases()), [](const auto& example) {
  std::string name = example.param.name;
  std::erase(name, ' ');
  return name;
});

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
