// Winding numbers change no faster than open edges allow, so that one holds for its neighbours.
#include "mesh/winding_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mesh/sidedness.h"
#include "mesh/winding/winding_number.h"
#include "unit/mesh/prepared.h"

namespace medial_vk {
namespace {

using namespace test;

/// Open where z is above the height.
Mesh open_capsule(double height) {
  Mesh mesh = make_capsule(0.4, 1, 32);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.vertices[v][2] > height; });
  });
  return mesh;
}

WindingChange change_of(const Mesh& mesh) { return {mesh, MeshTopology(mesh)}; }

TEST(WindingChange, ThereIsNoneOnAClosedMesh) {
  EXPECT_EQ(change_of(make_box({1, 1, 1})).radius({0.5, 0.5, 1}, 1e-9, 1), std::numeric_limits<double>::infinity());
}

TEST(WindingChange, IsAtMostAsStated) {
  const Mesh mesh = open_capsule(0.55);
  const WindingChange change = change_of(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double greatest = 0;
  for (int i = 0; i < 200; ++i) {
    const Point p = {0.2 * uniform(random), 0.2 * uniform(random), 0.6 * uniform(random)};  // away from the surface
    constexpr double kMost = 0.1;
    const double radius = std::min(change.radius(p, kMost, 1e-6), 0.1);
    ASSERT_GT(radius, 0);
    const double w = exact_winding_number(mesh, p);
    for (int k = 0; k < 8; ++k) {
      Point direction = {uniform(random), uniform(random), uniform(random)};
      direction = (radius / length(direction)) * direction;
      const double found = std::abs(exact_winding_number(mesh, p + direction) - w);
      ASSERT_LE(found, kMost);
      greatest = std::max(greatest, found);
    }
  }
  EXPECT_GT(greatest, 0.03);  // the bound is no idle one
}

TEST(WindingChange, HasNoRadiusBelowTheLeast) {
  const WindingChange change = change_of(open_capsule(0.55));
  const Point near_the_rim = {0.38, 0, 0.5};
  const double radius = change.radius(near_the_rim, 0.1, 1e-6);
  EXPECT_GT(radius, 0);
  EXPECT_GE(change.radius(near_the_rim, 0.1, radius), radius);
  EXPECT_EQ(change.radius(near_the_rim, 0.1, 1), 0);
}

/// Triangles in a row, with three open edges each.
Mesh triangles_in_a_row(std::uint32_t count) {
  Mesh soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = i;
    soup.vertices.insert(soup.vertices.end(), {{x, 0, 0}, {x + 0.5, 0, 0}, {x, 0.5, 0}});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

TEST(WindingChange, IsAtMostAsStatedAmongThousandsOfOpenEdges) {
  const Mesh soup = triangles_in_a_row(1500);
  const WindingChange change = change_of(soup);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t found = 0;
  for (int i = 0; i < 50; ++i) {
    const Point p = {750 + 750 * uniform(random), 0.25 + uniform(random), 0.1 + std::abs(uniform(random))};
    constexpr double kMost = 0.02;
    const double radius = change.radius(p, kMost, 1e-6), w = exact_winding_number(soup, p);
    if (radius == 0) continue;
    ++found;
    EXPECT_LE(std::abs(exact_winding_number(soup, p + Point{0, 0, radius}) - w), kMost);
    EXPECT_LE(std::abs(exact_winding_number(soup, p + Point{radius, 0, 0}) - w), kMost);
  }
  EXPECT_EQ(found, 50u);
}

TEST(WindingChange, HasNoRadiusIfNoChangeIsPermitted) {
  const WindingChange change = change_of(triangles_in_a_row(1));
  EXPECT_EQ(change.radius({0.1, 0.1, 0}, 0, 1), 0);
  EXPECT_EQ(change.radius({0.1, 0.1, 9}, 0, 1), 0);
}

TEST(WindingChange, IsUnknownAmongTooManyOpenEdges) {
  EXPECT_EQ(change_of(triangles_in_a_row(22000)).radius({0, 0, 100}, 1, 1e-6), 0);
}

TEST(WindingChange, SidesOfAnOpenMeshAreThoseOfEveryTriangle) {
  Mesh mesh = together(open_capsule(0.6), over(moved(make_sphere(0.3, 500), {0, 0.05, 0})));
  MeshTopology topology(mesh);
  TriangleTree tree(mesh);
  const SurfaceParts parts = find_parts(mesh, topology);
  const SelfIntersections intersections = find_self_intersections(mesh, tree, 1);
  const Sidedness sides = decide_sides(mesh, topology, tree, parts, false, intersections, 1);
  ASSERT_TRUE(sides.known);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Point centroid{0, 0, 0};
    for (const std::uint32_t v : mesh.triangles[i]) centroid = centroid + (1.0 / 3) * mesh.vertices[v];
    double beside = 0;
    for (const Triangle& t : mesh.triangles) {
      if (&t != &mesh.triangles[i])
        beside += triangle_winding({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, centroid);
    }
    for (const double threshold : {0.03, 0.97, 1.0}) {
      if (std::abs(beside - threshold) < 0.03) continue;  // the error of WindingTree
      ++checked;
      EXPECT_EQ(sides.beside[i] >= threshold, beside >= threshold) << i << ": " << sides.beside[i] << ", " << beside;
    }
  }
  EXPECT_GT(checked, 2 * mesh.triangles.size());
}

}  // namespace
}  // namespace medial_vk
