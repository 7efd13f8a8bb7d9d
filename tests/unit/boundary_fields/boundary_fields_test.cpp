// What was measured at vertices by name, its summaries, and finer meshes of the same surface.
#include "boundary_fields/boundary_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "boundary_fields/refined_mesh.h"
#include "boundary_fields/summaries.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;

Thickness wall(double lower, double upper, double object_angle = 1.5) {
  Thickness thickness;
  thickness.diameter = {lower, upper};
  thickness.ball = {{lower, 0, 0}, lower / 2};
  thickness.object_angle = object_angle;
  thickness.contacts = {Point{0, lower, 0}, Point{0, 0, upper}};
  thickness.kind = object_angle >= 1.2 ? ThicknessKind::kWall : ThicknessKind::kCrease;
  return thickness;
}

double length(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const Point& p = mesh.vertices[a];
  const Point& q = mesh.vertices[b];
  return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    Point u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = mesh.vertices[t[1]][k] - mesh.vertices[t[0]][k];
      v[k] = mesh.vertices[t[2]][k] - mesh.vertices[t[0]][k];
    }
    sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return sum;
}

TEST(BoundaryFields, HaveNumbersByName) {
  BoundaryFields fields;
  add_thickness(fields, std::vector<Thickness>{wall(1, 2), wall(3, 4, 0.5)});
  EXPECT_THAT(fields.find(field_names::kThicknessLower)->values, ElementsAre(1, 3));
  EXPECT_THAT(fields.find(field_names::kThicknessUpper)->values, ElementsAre(2, 4));
  EXPECT_THAT(fields.find(field_names::kObjectAngle)->values, ElementsAre(1.5, 0.5));
  EXPECT_THAT(fields.find(field_names::kThicknessKind)->values, ElementsAre(4, 2));
  EXPECT_TRUE(fields.find(field_names::kThicknessKind)->is_whole);
  EXPECT_EQ(fields.find(field_names::kKappa1), nullptr);
  ASSERT_EQ(fields.of_balls.size(), 4u);
  EXPECT_EQ(fields.of_balls[0].name, field_names::kBallCentre);
  EXPECT_THAT(fields.of_balls[0].values, ElementsAre(1, 0, 0, 3, 0, 0));
  EXPECT_THAT(fields.of_balls[1].values, ElementsAre(0.5, 1.5));
  EXPECT_THAT(fields.of_balls[2].values, ElementsAre(0, 1, 0, 0, 3, 0));
  EXPECT_THAT(fields.of_balls[3].values, ElementsAre(0, 0, 2, 0, 0, 4));
}

TEST(BoundaryFields, HaveWordsForKinds) {
  std::vector<std::string_view> names;
  for (const ThicknessKind kind : kThicknessKinds) names.push_back(kind_name(kind));
  EXPECT_THAT(names, ElementsAre("none", "facets", "crease", "corner", "wall"));
}

TEST(BoundaryFields, TakeTheSheetOfTheBallThatGivesTheCurvature) {
  VertexCurvature known, unknown;
  known.state = CurvatureState::kCut;
  known.kappa = {2, -1};
  known.directions = {Point{1, 0, 0}, Point{0, 1, 0}};
  known.ball = 1;
  std::vector<MedialSphere> spheres(2);
  spheres[1].sheet = 7;
  BoundaryFields fields;
  add_curvature(fields, std::vector<VertexCurvature>{known, unknown}, spheres);
  EXPECT_THAT(fields.find(field_names::kSheet)->values, ElementsAre(7, -1));
  EXPECT_THAT(fields.find(field_names::kCurvatureState)->values, ElementsAre(1, 5));
  EXPECT_EQ(state_name(known.state), "cut");
  EXPECT_EQ(state_name(unknown.state), "few");
  EXPECT_EQ(fields.find(field_names::kKappa2)->values[0], -1);
  EXPECT_TRUE(std::isnan(fields.find(field_names::kKappa2)->values[1]));
  EXPECT_EQ(fields.find(field_names::kDirection2)->values[1], 1);
}

/// A thinner place counts as a wall only with a ball whose object angle is that of a wall.
TEST(ThicknessSummary, FindsTheLeastWallAndTheWideIntervals) {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  Thickness none = wall(0, 5);
  none.ball.radius = 0;
  none.kind = ThicknessKind::kNone;
  ThicknessOptions how;
  how.delta = 0.1;
  const std::vector<Thickness> found = {wall(3, 3.1), wall(1, 1.05, 1.1), wall(2, 2.3), none, wall(4, 4.01)};
  const ThicknessRecord record = summarise_thickness(points, found, how);
  ASSERT_TRUE(record.least.has_value());
  EXPECT_EQ(record.least->lower, 2);
  EXPECT_EQ(record.least->upper, 2.3);
  EXPECT_EQ(record.least_at, (Point{2, 0, 0}));
  EXPECT_EQ(record.median.lower, 2);
  EXPECT_EQ(record.median.upper, 3.1);
  EXPECT_EQ(record.wide, 2u);
  EXPECT_EQ(record.greatest, 5);
  EXPECT_EQ(record.share(ThicknessKind::kWall), 0.6);
  EXPECT_EQ(record.share(ThicknessKind::kCrease), 0.2);
  EXPECT_EQ(record.share(ThicknessKind::kNone), 0.2);
  EXPECT_EQ(record.share(ThicknessKind::kCorner), 0);
  EXPECT_EQ(record.delta, 0.1);
  EXPECT_EQ(record.wall_angle, how.wall_angle);
  how.delta = 0.11;  // of the wall, the ball is less than ten
  EXPECT_FALSE(summarise_thickness(points, std::vector<Thickness>{wall(1, 1.05)}, how).least.has_value());
  EXPECT_FALSE(summarise_thickness({}, {}, how).least.has_value());
}

/// Of two triangles in a plane, the vertices of the larger one alone are known.
TEST(CurvatureSummary, CountsAreaAndNotVertices) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {10, 0, 0}, {11, 0, 0}, {10, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  std::vector<VertexCurvature> curvature(6);
  for (std::size_t i = 0; i < 3; ++i) {
    curvature[i].kappa = {static_cast<double>(i), -1.0 - static_cast<double>(i)};
    curvature[i].error = static_cast<double>(i);
    curvature[i].state = CurvatureState::kKnown;
  }
  curvature[3].kappa = {1, curvature[3].kappa[1]};  // a third of a quarter of the area; the other one is unknown
  curvature[3].state = CurvatureState::kCurve;
  curvature[4].state = CurvatureState::kUncertain;
  curvature[5].state = CurvatureState::kEdge;
  BoundaryFields fields;
  add_curvature(fields, curvature, {});
  const CurvatureRecord record = summarise_curvature(mesh, fields);
  EXPECT_DOUBLE_EQ(record.unknown_share, 0.25);
  EXPECT_DOUBLE_EQ(record.none_share, 0.25 * 2 / 3);
  EXPECT_EQ(record.kappa_1->greatest, 2);
  EXPECT_EQ(record.kappa_2->least, -3);
  EXPECT_EQ(record.median_error, 1);
  const auto share_of = [&](CurvatureState state) { return record.state_shares[static_cast<std::size_t>(state)]; };
  EXPECT_DOUBLE_EQ(share_of(CurvatureState::kKnown), 0.75);
  EXPECT_DOUBLE_EQ(share_of(CurvatureState::kCurve), 0.25 / 3);
  EXPECT_DOUBLE_EQ(share_of(CurvatureState::kUncertain), 0.25 / 3);
  EXPECT_DOUBLE_EQ(share_of(CurvatureState::kEdge), 0.25 / 3);
  EXPECT_EQ(share_of(CurvatureState::kFew), 0);
}

TEST(RefineMesh, KeepsTheSurfaceClosedAndItsVerticesFirst) {
  const Mesh mesh = test::make_box({4, 2, 1});
  // Coordinates are sums of few powers of two, so that middles and areas are exact.
  const Mesh refined = refine_mesh(mesh, 0.5);
  ASSERT_GT(refined.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) EXPECT_EQ(refined.vertices[i], mesh.vertices[i]);
  EXPECT_EQ(area(refined), area(mesh));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : refined.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(length(refined, t[i], t[(i + 1) % 3]), 0.5);
      ++edges[{t[i], t[(i + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(RefineMesh, LeavesAFineMeshAsItIs) {
  const Mesh mesh = test::make_box({4, 2, 1});
  const Mesh same = refine_mesh(mesh, 5);
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.triangles, mesh.triangles);
}

}  // namespace
}  // namespace medial_vk
