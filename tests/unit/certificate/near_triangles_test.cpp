// The certificate's queries of triangles near a ball, against all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>

#include "bvh/nearby_triangles.h"
#include "certificate/near_triangles.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

Bvh tree_of(Mesh mesh, double scale, const Point& shift) {
  for (Point& p : mesh.vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = scale * p[axis] + shift[axis];
  Result<Bvh> bvh = Bvh::build(test::view_of(mesh));
  EXPECT_TRUE(bvh.ok());
  return std::move(bvh).value();
}

void expect_same(const BvhHit& a, const BvhHit& b) {
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.squared_distance, b.squared_distance);
  EXPECT_EQ(a.point, b.point);
}

/// Balls around points anywhere in the box, just large enough for some triangle, within a region and beside it.
void expect_no_triangle_missing(const Bvh& bvh, unsigned seed) {
  const NearTriangles triangles(bvh);
  const BvhBox& box = bvh.nodes().front().box;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Region region;
  std::vector<std::uint32_t> found;
  std::vector<float> bounds;
  int fewer = 0;
  for (int i = 0; i < 300; ++i) {
    Point p;
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = box.lower[axis] + share(random) * (box.upper[axis] - box.lower[axis]);
    const double radius = std::sqrt(bvh.closest(p).squared_distance) * (1 + 1e-9 + 0.2 * share(random));
    if (i % 3 == 0) triangles.surround(p, 1.5 * radius, region);
    const double inner_radius = radius * (i % 2 == 0 ? 1 : 0.95);
    const std::size_t inner = triangles.gather(region, p, radius, inner_radius, found);
    ASSERT_LE(inner, found.size());
    fewer += inner < found.size() ? 1 : 0;
    std::vector<std::uint32_t> first(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(inner));
    std::ranges::sort(first);
    std::ranges::sort(found);
    EXPECT_TRUE(std::ranges::adjacent_find(found) == found.end());
    std::vector<std::uint32_t> one(1);
    for (one[0] = 0; one[0] < bvh.corners().size(); ++one[0]) {
      const bool is_near = closest_of(bvh, p, one).squared_distance <= radius * radius;
      EXPECT_TRUE(!is_near || std::ranges::binary_search(found, one[0]));
      const bool is_inner = closest_of(bvh, p, one).squared_distance <= inner_radius * inner_radius;
      EXPECT_TRUE(!is_inner || std::ranges::binary_search(first, one[0]));
      EXPECT_EQ(find_within(bvh, p, radius, one) == 0, std::sqrt(closest_of(bvh, p, one).squared_distance) < radius);
    }
    EXPECT_LT(found.size(), bvh.corners().size());
    expect_same(triangles.closest_of(p, found, bounds), bvh.closest(p));
  }
  EXPECT_GT(fewer, 0);
}

TEST(NearTriangles, NoneIsMissing) {
  expect_no_triangle_missing(tree_of(test::make_turned_torus(24, 12), 1, {0, 0, 0}), 1);
}

TEST(NearTriangles, NoneIsMissingFarFromTheOrigin) {
  expect_no_triangle_missing(tree_of(test::make_turned_torus(24, 12), 1, {1e6, -3e6, 2e5}), 2);
}

// Ties and near-ties: along the axis of a capsule all faces around are at one distance, up to rounding.
TEST(NearTriangles, TheClosestIsThatOfAllInDouble) {
  const Bvh bvh = tree_of(test::make_capsule(0.5, 2.0, 40), 1, {0.1, 0.2, 0.3});
  const NearTriangles triangles(bvh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  Region region;
  std::vector<std::uint32_t> found;
  std::vector<float> bounds;
  for (int i = 0; i < 2000; ++i) {
    const double off = std::pow(10.0, -2 - i % 14);
    const Point p = {0.1 + off * share(random), 0.2 + off * share(random), 0.3 + 0.4 * share(random)};
    const double radius = std::sqrt(bvh.closest(p).squared_distance) * (1 + 1e-9);
    triangles.surround(p, radius, region);
    const std::size_t inner = triangles.gather(region, p, radius, radius, found);
    expect_same(triangles.closest_of(p, std::span(found).first(inner), bounds), bvh.closest(p));
  }
}

// Needles, points, duplicates, far from points and in reach or out of it.
TEST(NearTriangles, TheClosestOfTrianglesOfAnyShape) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0, 1);
  const auto anywhere = [&](double low, double high) {
    return Point{low + (high - low) * share(random), low + (high - low) * share(random),
                 low + (high - low) * share(random)};
  };
  for (int round = 0; round < 40; ++round) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < 40; ++i) {
      const Point a = anywhere(0, 1), b = anywhere(0, 1);
      Point c = i % 4 == 0 ? a : anywhere(0, 1);
      for (std::size_t axis = 0; axis < 3; ++axis)
        c[axis] = i % 4 == 1 ? 0.5 * (a[axis] + b[axis]) + std::pow(10.0, -round) * share(random) : c[axis];
      mesh.vertices.insert(mesh.vertices.end(), {a, i % 4 == 2 ? a : b, c});
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      if (i % 5 == 0) mesh.triangles.push_back(mesh.triangles.back());
    }
    const Bvh bvh = tree_of(std::move(mesh), 1, {0, 0, 0});
    const NearTriangles triangles(bvh);
    std::vector<std::uint32_t> all(bvh.corners().size());
    std::vector<float> bounds;
    for (int i = 0; i < 100; ++i) {
      const Point p = anywhere(-2, 3);
      std::iota(all.begin(), all.end(), 0u);
      expect_same(triangles.closest_of(p, all, bounds), closest_of(bvh, p, all));
    }
  }
}

TEST(NearTriangles, NothingIsClosestOfNone) {
  const Bvh bvh = tree_of(test::make_turned_torus(24, 12), 1, {0, 0, 0});
  const NearTriangles triangles(bvh);
  std::vector<float> bounds;
  EXPECT_EQ(triangles.closest_of({0, 0, 0}, {}, bounds).triangle, 0xffffffffu);
}

TEST(NearTriangles, NoneIsMissingOfTinyAndOfHugeMeshes) {
  expect_no_triangle_missing(tree_of(test::make_turned_torus(24, 12), 1e-15, {0, 0, 0}), 3);
  expect_no_triangle_missing(tree_of(test::make_turned_torus(24, 12), 1e20, {0, 0, 0}), 4);
}

}  // namespace
}  // namespace medial_vk
