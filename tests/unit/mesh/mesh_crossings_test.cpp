// Crossing triangles are found; neighbours, flat regions and grids are not taken for crossings.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/crossings/self_intersections.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

SelfIntersections find(const Mesh& mesh) { return find_self_intersections(mesh, TriangleTree(mesh)); }

TEST(Crossings, NoneOnCleanSolids) {
  for (Mesh mesh : {make_box({1, 2, 3}), make_sphere(1, 5000), make_capsule(1, 3, 40), make_ellipsoid({3, 2, 0.01}, 60),
                    make_l_shape(4, 1, 2), make_cup(2, 0.01, 3, 50), make_torus(2, 0.7, 30, 60),
                    make_plate_with_hole(4, 1e-6, 1)}) {
    for (int i = 0; i < 4; ++i) {
      const SelfIntersections found = find(mesh);
      EXPECT_TRUE(found.known);
      EXPECT_EQ(found.count, 0u) << i;
      if (i == 0) rotate(mesh, {1, 2, 3}, 0.7);
      if (i == 1) scale(mesh, 1e-6);
      if (i == 2) scale(mesh, 1e12);
    }
  }
}

TEST(Crossings, NoneOnAFlatGrid) {
  // All in one plane, all vertices on lines: only those lines separate the triangles.
  for (const double angle : {0.0, 0.3}) {
    Mesh mesh;
    const std::uint32_t n = 20;
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) mesh.vertices.push_back({i * 0.1, j * 0.1, 0});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      }
    }
    rotate(mesh, {1, 1, 0.2}, angle);
    EXPECT_EQ(find(mesh).count, 0u);
  }
}

TEST(Crossings, TwoSpheres) {
  Mesh mesh = make_sphere(1, 500);
  Mesh other = make_sphere(1, 500);
  translate(other, {1.03, 0.02, 0.01});
  const std::size_t first = mesh.triangles.size();
  append(mesh, other);
  const SelfIntersections found = find(mesh);
  EXPECT_TRUE(found.known);
  EXPECT_GT(found.count, 40u);
  EXPECT_LT(found.count, 200u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {  // only near the circle x = 0.515
    if (!found.crossed[i]) continue;
    for (const std::uint32_t v : mesh.triangles[i]) EXPECT_NEAR(mesh.vertices[v][0], 0.515, 0.25) << (i < first);
  }
}

TEST(Crossings, TouchingCounts) {
  Mesh mesh = make_box({1, 1, 1});
  Mesh other = make_box({0.5, 0.5, 0.5});
  translate(other, {1, 0.25, 0.25});  // face on face
  append(mesh, other);
  EXPECT_GE(find(mesh).count, 4u);
  Mesh apart = make_box({1, 1, 1});
  translate(other, {1e-12, 0, 0});
  append(apart, other);
  EXPECT_EQ(find(apart).count, 0u);
}

TEST(Crossings, NeighboursThatFoldOrPierce) {
  const Point p = {0, 0, 0}, q = {1, 0, 0}, a = {0.3, 1, 0};
  EXPECT_TRUE(certainly_meet_at_side(p, q, a, {0.5, -1, 0}));
  EXPECT_TRUE(certainly_meet_at_side(p, q, a, {0.5, 1, 1e-9}));
  EXPECT_FALSE(certainly_meet_at_side(p, q, a, {0.5, 1, 0}));  // folded back in the plane
  // One vertex shared: side by side, opposite, in one plane with sides in line; and through each other.
  const Point o = {0, 0, 0}, x = {1, 0, 0}, y = {0, 1, 0};
  EXPECT_TRUE(certainly_meet_at_apex(o, x, y, {-1, 0, 0}, {0, -1, 0}));
  EXPECT_TRUE(certainly_meet_at_apex(o, x, y, {-1, 0, 0}, {-1, 0.1, 0}));
  EXPECT_TRUE(certainly_meet_at_apex(o, x, {-1, 0.2, 0}, {-1, 0, 0}, {-1, -0.1, 0}));
  EXPECT_TRUE(certainly_meet_at_apex(o, x, y, {1, 1, 1}, {1, -1, 0}));
  EXPECT_FALSE(certainly_meet_at_apex(o, x, y, {0, 0, 1}, {0, 0.1, -0.9999}));  // touches its side y
  EXPECT_FALSE(certainly_meet_at_apex(o, x, y, {1, 1, 1}, {1, 1, -1}));
  EXPECT_FALSE(certainly_meet_at_apex(o, x, y, {0.5, 0.5, 0}, {1, -1, 0}));  // overlap in the plane
  EXPECT_FALSE(certainly_meet_at_apex(o, x, y, x, {1, -1, 0}));              // share a direction
}

/// Against the definition: do two segments' planes cut? By dense sampling of random pairs.
TEST(Crossings, AgreeWithSegmentTests) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Point{uniform(random), uniform(random), uniform(random)}; };
  const auto orient = [](const Point& a, const Point& b, const Point& c, const Point& d) {
    double m[3][3];
    for (int k = 0; k < 3; ++k) {
      m[0][k] = b[k] - a[k];
      m[1][k] = c[k] - a[k];
      m[2][k] = d[k] - a[k];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  const auto pierces = [&](const Point& p, const Point& q, const std::array<Point, 3>& t) {
    if (orient(t[0], t[1], t[2], p) * orient(t[0], t[1], t[2], q) > 0) return false;
    const double a = orient(p, q, t[0], t[1]), b = orient(p, q, t[1], t[2]), c = orient(p, q, t[2], t[0]);
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
  };
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::array<Point, 3> a = {point(), point(), point()}, b = {point(), point(), point()};
    bool expected = false;
    for (int k = 0; k < 3; ++k)
      expected = expected || pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a);
    EXPECT_EQ(certainly_disjoint(a, b), !expected);
    const bool at_apex = pierces(a[1], a[2], {a[0], b[1], b[2]}) || pierces(b[1], b[2], a);
    EXPECT_EQ(certainly_meet_at_apex(a[0], a[1], a[2], b[1], b[2]), !at_apex);
    crossing += expected;
  }
  EXPECT_GT(crossing, 1000);
}

TEST(Crossings, ATangleIsGivenUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  Mesh mesh;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back({uniform(random), uniform(random), uniform(random)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const SelfIntersections found = find(mesh);
  EXPECT_FALSE(found.known);
}

}  // namespace
}  // namespace medial_vk
