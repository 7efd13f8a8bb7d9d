// The hierarchy on the host: structure, independence of the thread count, queries against all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "bvh/refined_tree.h"
#include "medial_vk/bvh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// Nearest point by Ericson's regions, in long double: slow, and independent of the code under test.
long double distance_by_regions(const Point& p, const Mesh& mesh, const Triangle& t) {
  using Real = long double;
  std::array<Real, 3> ab, ac, ap;
  for (int k = 0; k < 3; ++k) {
    ab[k] = static_cast<Real>(mesh.vertices[t[1]][k]) - mesh.vertices[t[0]][k];
    ac[k] = static_cast<Real>(mesh.vertices[t[2]][k]) - mesh.vertices[t[0]][k];
    ap[k] = static_cast<Real>(p[k]) - mesh.vertices[t[0]][k];
  }
  const auto dot = [](const auto& x, const auto& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
  const Real d1 = dot(ab, ap), d2 = dot(ac, ap), aa = dot(ab, ab), bb = dot(ac, ac), cc = dot(ab, ac);
  const Real d3 = d1 - aa, d4 = d2 - cc, d5 = d1 - cc, d6 = d2 - bb;
  const Real vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  Real v, w;
  if (d1 <= 0 && d2 <= 0) {
    v = w = 0;
  } else if (d3 >= 0 && d4 <= d3) {
    v = 1, w = 0;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    v = d1 / (d1 - d3), w = 0;
  } else if (d6 >= 0 && d5 <= d6) {
    v = 0, w = 1;
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    v = 0, w = d2 / (d2 - d6);
  } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    w = (d4 - d3) / ((d4 - d3) + (d5 - d6)), v = 1 - w;
  } else {
    v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  }
  Real sum = 0;
  for (int k = 0; k < 3; ++k) sum += (ap[k] - v * ab[k] - w * ac[k]) * (ap[k] - v * ab[k] - w * ac[k]);
  return std::sqrt(sum);
}

std::vector<Point> random_points(int count, unsigned seed, double reach) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  std::vector<Point> points(count);
  for (Point& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

/// Returns the depth of the tree and checks boxes and leaf ranges.
std::uint32_t check_subtree(const Bvh& bvh, std::uint32_t index, std::vector<std::uint8_t>& seen) {
  const BvhNode& node = bvh.nodes()[index];
  if (node.count == 0) {
    std::uint32_t depth = 0;
    for (std::uint32_t child = node.first; child < node.first + 2; ++child) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(node.box.lower[k], bvh.nodes()[child].box.lower[k]);
        EXPECT_GE(node.box.upper[k], bvh.nodes()[child].box.upper[k]);
      }
      depth = std::max(depth, check_subtree(bvh, child, seen));
    }
    return depth + 1;
  }
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    ++seen[i];
    for (const Point& corner : bvh.corners()[i]) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(node.box.lower[k], corner[k]);
        EXPECT_GE(node.box.upper[k], corner[k]);
      }
    }
  }
  return 0;
}

void expect_sound(const Bvh& bvh, std::size_t triangles) {
  std::vector<std::uint8_t> seen(triangles, 0);
  EXPECT_LE(check_subtree(bvh, 0, seen), Bvh::kMaxDepth);
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](std::uint8_t n) { return n == 1; }));
  std::vector<std::uint32_t> order = bvh.order();
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(Bvh, HoldsEveryTriangleOnce) {
  const Mesh mesh = test::make_turned_torus();
  for (const std::uint32_t leaf_size : {1u, 4u, 8u}) {
    const auto bvh = Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size});
    ASSERT_TRUE(bvh.ok());
    expect_sound(bvh.value(), mesh.triangles.size());
  }
}

TEST(Bvh, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = test::make_sphere(1.0, 20000);
  const auto one = Bvh::build(test::view_of(mesh), {.threads = 1});
  for (const unsigned threads : {2u, 3u, 8u}) {
    const auto many = Bvh::build(test::view_of(mesh), {.threads = threads});
    ASSERT_EQ(one.value().nodes().size(), many.value().nodes().size());
    EXPECT_EQ(one.value().order(), many.value().order());
    for (std::size_t i = 0; i < one.value().nodes().size(); ++i) {
      EXPECT_EQ(one.value().nodes()[i].first, many.value().nodes()[i].first);
      EXPECT_EQ(one.value().nodes()[i].count, many.value().nodes()[i].count);
    }
  }
}

TEST(Bvh, StaysShallowWhenTrianglesShrinkGeometrically) {
  Mesh mesh;
  double x = 1;
  for (std::uint32_t i = 0; i < 900; ++i, x *= 0.5) {
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 0}, {1.2 * x, 0, 0}, {x, 0.2 * x, 0}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto bvh = Bvh::build(test::view_of(mesh), {.leaf_size = 1});
  ASSERT_TRUE(bvh.ok());
  expect_sound(bvh.value(), mesh.triangles.size());
  // The coarse tree has used up its depth before its leaves are split.
  expect_sound(refined_tree(Bvh::build(test::view_of(mesh), {.leaf_size = 64}).value(), 1).value(),
               mesh.triangles.size());
}

TEST(Bvh, HandlesManyTrianglesInOnePlace) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(1000, {0, 1, 2});
  const auto bvh = Bvh::build(test::view_of(mesh));
  ASSERT_TRUE(bvh.ok());
  expect_sound(bvh.value(), mesh.triangles.size());
  const BvhHit hit = bvh.value().closest({0.2, 0.2, 0.5});
  EXPECT_EQ(hit.triangle, 0u);
  EXPECT_DOUBLE_EQ(hit.squared_distance, 0.25);
}

TEST(Bvh, RefinedIsTheTreeOfSmallerLeaves) {
  for (const Mesh& mesh : {test::make_torus(1.0, 0.4, 40, 30, 0.5), test::make_box({1, 2, 3})}) {
    const Bvh coarse = Bvh::build(test::view_of(mesh), {.leaf_size = 8}).value();
    for (const std::uint32_t leaf_size : {1u, 2u, 4u, 8u}) {
      const Bvh fine = refined_tree(coarse, leaf_size).value(),
                built = Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size}).value();
      EXPECT_EQ(fine.order(), built.order());
      EXPECT_TRUE(fine.corners() == built.corners());
      ASSERT_EQ(fine.nodes().size(), built.nodes().size());
      for (std::size_t i = 0; i < fine.nodes().size(); ++i) {
        const BvhNode &a = fine.nodes()[i], &b = built.nodes()[i];
        EXPECT_TRUE(a.first == b.first && a.count == b.count && a.box.lower == b.box.lower &&
                    a.box.upper == b.box.upper);
      }
    }
  }
}

// The error of both evaluations is a few units in the last place of coordinates of size about 2: far below 1e-14.
TEST(Bvh, FindsTheNearestPoint) {
  const Mesh mesh = test::make_turned_torus();
  const auto bvh = Bvh::build(test::view_of(mesh));
  for (const Point& p : random_points(500, 1, 2.0)) {
    long double truth = std::numeric_limits<long double>::infinity();
    for (const Triangle& t : mesh.triangles) truth = std::min(truth, distance_by_regions(p, mesh, t));
    const BvhHit hit = bvh.value().closest(p);
    const double distance = std::sqrt(hit.squared_distance);
    ASSERT_NEAR(distance, static_cast<double>(truth), 1e-14);
    EXPECT_NEAR(static_cast<double>(distance_by_regions(p, mesh, mesh.triangles[hit.triangle])), distance, 1e-14);
    EXPECT_NEAR(std::hypot(hit.point[0] - p[0], hit.point[1] - p[1], hit.point[2] - p[2]), distance, 1e-14);
    EXPECT_EQ(bvh.value().closest(p, distance * (1 - 1e-12)).triangle, 0xffffffffu);
    EXPECT_EQ(bvh.value().closest(p, distance * (1 + 1e-12)).triangle, hit.triangle);
    EXPECT_FALSE(bvh.value().any_within(p, distance * (1 - 1e-12)));
    EXPECT_TRUE(bvh.value().any_within(p, distance * (1 + 1e-12)));
  }
}

TEST(Bvh, BreaksTiesByTheSmallestIndex) {
  const Mesh mesh = test::make_box({2, 2, 2});
  for (const std::uint32_t leaf_size : {1u, 2u, 12u}) {
    const BvhHit hit = Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size}).value().closest({1, 1, 1});
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_DOUBLE_EQ(hit.squared_distance, 1.0);
  }
}

// Triangles of length 1 and width 10^-k. Away from the plane's line the long-double formula of regions is itself
// ill-conditioned, so the reference is a dense search over the (nearly one-dimensional) triangle's long edges.
TEST(Bvh, IsAccurateOnNeedles) {
  for (int k = 1; k <= 15; ++k) {
    const double width = std::pow(10.0, -k);
    Mesh mesh;
    mesh.vertices = {{0.1, 0.2, 0.3}, {0.7, 0.9, 0.6}, {0.7 + width, 0.9 - 0.5 * width, 0.6 + 0.25 * width}};
    mesh.triangles = {{0, 1, 2}};
    const auto bvh = Bvh::build(test::view_of(mesh));
    for (const Point& p : random_points(200, static_cast<unsigned>(k), 1.0)) {
      const double distance = std::sqrt(bvh.value().closest(p).squared_distance);
      const Point a = mesh.vertices[0];
      const Point ab = {mesh.vertices[1][0] - a[0], mesh.vertices[1][1] - a[1], mesh.vertices[1][2] - a[2]};
      const Point ap = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
      const double t = std::clamp(
          (ap[0] * ab[0] + ap[1] * ab[1] + ap[2] * ab[2]) / (ab[0] * ab[0] + ab[1] * ab[1] + ab[2] * ab[2]), 0.0, 1.0);
      const double to_edge = std::hypot(ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]);
      // Every point of the triangle is within 1.2 widths of its edge ab.
      ASSERT_LE(distance, to_edge + 1e-15);
      ASSERT_GE(distance, to_edge - 1.2 * width - 1e-15);
      if (k <= 6) {
        const double truth = static_cast<double>(distance_by_regions(p, mesh, mesh.triangles[0]));
        ASSERT_NEAR(distance, truth, 1e-15 + 1e-19 / (width * width)) << "width " << width;
      }
    }
  }
}

TEST(Bvh, RefusesWhatIsNoMesh) {
  Mesh mesh = test::make_box({1, 1, 1});
  Mesh empty;
  EXPECT_EQ(Bvh::build(test::view_of(empty)).error().message, "the mesh has no triangle");
  mesh.triangles[7][1] = 99;
  EXPECT_EQ(Bvh::build(test::view_of(mesh)).error().message, "face 7 uses vertex 99 of 8");
  mesh = test::make_box({1, 1, 1});
  mesh.vertices[3][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Bvh::build(test::view_of(mesh)).error().message, "vertex 3 has a coordinate that is not finite");
}

}  // namespace
}  // namespace medial_vk
