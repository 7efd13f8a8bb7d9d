// Meshes of hulls: closed, on the surface, within the tolerance, few triangles, symmetric.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"
#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

/// Closed, of the topology of a sphere, counter-clockwise, without repeated corners.
void expect_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NE(t[k], t[(k + 1) % 3]);
      ++edges[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(mesh.triangles.size(), 2 * mesh.vertices.size() - 4);
}

double greatest_surface_error(const Mesh& mesh, const BallHull& hull) {
  double greatest_error = 0;
  for (const Point& p : mesh.vertices) greatest_error = std::max(greatest_error, std::fabs(signed_distance(hull, p)));
  return greatest_error;
}

/// Of points of the triangles.
double greatest_sampled_depth(const Mesh& mesh, const BallHull& hull) {
  double depth = 0;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i <= 4; ++i) {
      for (int k = 0; i + k <= 4; ++k) {
        const Point p = mesh.vertices[t[0]] + i / 4.0 * (mesh.vertices[t[1]] - mesh.vertices[t[0]]) +
                        k / 4.0 * (mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        depth = std::max(depth, -signed_distance(hull, p));
      }
    }
  }
  return depth;
}

/// The greatest of what the hull's support exceeds that of the vertices by, in some directions: for convex meshes in
/// the hull this is the distance from the surface to the mesh.
double greatest_support_gap(const Mesh& mesh, const BallHull& hull, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double gap = 0;
  for (int i = 0; i < 50; ++i) {
    Point n{};
    for (double& x : n) x = normal(random);
    n = (1 / length(n)) * n;
    double reach = -std::numeric_limits<double>::infinity();
    for (const Point& p : mesh.vertices) reach = std::max(reach, dot(n, p));
    gap = std::max(gap, support(hull, n) - reach);
  }
  return gap;
}

TEST(HullMesh, IsClosedOnTheSurfaceAndWithinTheTolerance) {
  std::mt19937_64 random(11);
  int made = 0;
  for (std::uint32_t i = 0; i < 1500 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const BallHull hull = test::random_hull(1 + i % 3, random);
    const double tolerance = std::pow(10, std::uniform_real_distribution<double>(-3, 0.5)(random));
    const Result<Mesh> mesh = mesh_of(hull, tolerance);
    if (!mesh.ok()) {
      EXPECT_EQ(volume_of(hull), 0) << mesh.error().message;
      continue;
    }
    ++made;
    expect_closed(mesh.value());
    EXPECT_LE(greatest_surface_error(mesh.value(), hull), 1e-13);
    EXPECT_LE(greatest_sampled_depth(mesh.value(), hull), tolerance);
    EXPECT_LE(greatest_support_gap(mesh.value(), hull, random), tolerance);
  }
  EXPECT_GT(made, 1000);
}

/// The number of triangles per vertex of the densest cover of a sphere by caps is that of a hexagonal grid: 4 pi over
/// its cell's area of 2.6 t^2, twice. These meshes have at most twice as many.
TEST(HullMesh, HasFewTriangles) {
  const double tolerance = 1e-4, angle = std::acos(1 - tolerance);
  const double least_count = 2 * 4 * std::acos(-1.0) / (2.598 * angle * angle);
  EXPECT_LT(mesh_of(hull_of({{0, 0, 0}, 1}), tolerance).value().triangles.size(), 2 * least_count);
  // A long capsule has the triangles of a ball and one strip more.
  const auto capsule = mesh_of(hull_of({{0, 0, 0}, 1}, {{100, 0, 0}, 1}), tolerance);
  EXPECT_LT(capsule.value().triangles.size(), 2.1 * least_count);
  // A flat slab: the triangles of its rim, and two large ones.
  const double r = 0.01;
  const auto slab = mesh_of(hull_of({{0, 0, 0}, r}, {{1, 0, 0}, r}, {{0, 1, 0}, r}), 1e-3);
  EXPECT_LT(slab.value().triangles.size(), 120u);
}

/// Whether every vertex has an image among the vertices.
template <class Map>
void expect_symmetric(const Mesh& mesh, const Map& map) {
  for (const Point& p : mesh.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& q : mesh.vertices) nearest = std::min(nearest, length(map(p) - q));
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(HullMesh, VerticesAreSymmetricWhereTheHullIs) {
  const auto across_x = [](const Point& p) { return Point{-p[0], p[1], p[2]}; };
  const auto across_y = [](const Point& p) { return Point{p[0], -p[1], p[2]}; };
  const auto across_z = [](const Point& p) { return Point{p[0], p[1], -p[2]}; };
  const Mesh ball = mesh_of(hull_of({{0, 0, 0}, 1}), 0.01).value();
  const Mesh capsule = mesh_of(hull_of({{0, 0, -1}, 0.5}, {{0, 0, 1}, 0.5}), 0.01).value();
  for (const Mesh* mesh : {&ball, &capsule}) {
    expect_symmetric(*mesh, across_x);
    expect_symmetric(*mesh, across_y);
    expect_symmetric(*mesh, across_z);
  }
  expect_symmetric(mesh_of(hull_of({{0, 0, -1}, 0.5}, {{0, 0, 1}, 0.25}), 0.01).value(), across_x);
  // Any slab has its plane; this one has another.
  const Mesh slab = mesh_of(hull_of({{-1, 0, 0}, 0.3}, {{1, 0, 0}, 0.3}, {{0, 2, 0}, 0.1}), 0.01).value();
  expect_symmetric(slab, across_z);
  expect_symmetric(slab, across_x);
}

TEST(HullMesh, NamesWhatItRefuses) {
  const BallHull ball = hull_of({{0, 0, 0}, 1});
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Result<Mesh> mesh = mesh_of(ball, tolerance);
    ASSERT_FALSE(mesh.ok());
    EXPECT_EQ(mesh.error().code, ErrorCode::kUsage);
    EXPECT_NE(mesh.error().message.find("tolerance"), std::string::npos);
  }
  for (const double tolerance : {1e-9, 1e-300}) {
    const Result<Mesh> fine = mesh_of(ball, tolerance);
    ASSERT_FALSE(fine.ok());
    EXPECT_NE(fine.error().message.find("2^24 triangles"), std::string::npos);
  }
  const Result<Mesh> flat = mesh_of(hull_of({{0, 0, 0}, 0}, {{1, 0, 0}, 0}, {{0, 1, 0}, 0}), 0.1);
  ASSERT_FALSE(flat.ok());
  EXPECT_NE(flat.error().message.find("no volume"), std::string::npos);
  EXPECT_FALSE(mesh_of(hull_of({{0, 0, 0}, -1}), 0.1).ok());
  EXPECT_FALSE(mesh_of(hull_of({{0, std::nan(""), 0}, 1}), 0.1).ok());
}

}  // namespace
}  // namespace medial_vk
