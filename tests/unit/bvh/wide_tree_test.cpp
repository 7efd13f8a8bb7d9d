// The tree with eight children a node gives the answers of the tree that it was made of.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "bvh/wide_tree.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// Points in and around the box, on the surface and far away.
std::vector<Point> points_around(const Mesh& mesh) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  const Point first = mesh.vertices[0];
  double size = 0;
  for (const Point& p : mesh.vertices) size = std::max(size, length(p - first));
  std::vector<Point> points;
  for (const double reach : {0.1, 1.0, 100.0, 1e9}) {
    for (int i = 0; i < 200; ++i) {
      points.push_back(first + (reach * size) * Point{normal(random), normal(random), normal(random)});
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 5) {
    const Triangle& c = mesh.triangles[t];
    points.push_back(mesh.vertices[c[0]]);
    points.push_back(0.5 * (mesh.vertices[c[0]] + mesh.vertices[c[1]]));
  }
  return points;
}

/// Distances are equal up to their rounding: less than 32 u times the lengths involved, u = 2^-53.
void expect_same(const Bvh& bvh, const WideTree& wide, const std::vector<Point>& points, const std::string& name) {
  const BvhBox& box = bvh.nodes().front().box;
  const double size = length(box.upper - box.lower) + length(box.lower);
  std::size_t different = 0;
  for (const Point& p : points) {
    const double distance = std::sqrt(bvh.closest(p).squared_distance);
    const double rounding = 32 * 0x1p-53 * (size + length(p));
    const BvhHit found = wide.closest(bvh, p), within = wide.closest(bvh, p, 1.001 * distance + 2 * rounding);
    const BvhHit beyond = wide.closest(bvh, p, 0.999 * distance - 2 * rounding);
    for (const BvhHit& hit : {found, within}) {
      different += std::fabs(std::sqrt(hit.squared_distance) - distance) <= rounding ? 0 : 1;
      different += length(hit.point - p) <= distance + rounding ? 0 : 1;
    }
    different += beyond.triangle != BvhHit().triangle ? 1 : 0;
  }
  EXPECT_EQ(different, 0u) << name;
}

void expect_same_trees(const Mesh& mesh, const std::string& name) {
  for (const std::uint32_t leaf_size : {1u, 4u, 30u}) {
    const Bvh bvh = Bvh::build(test::view_of(mesh), {leaf_size, 1}).value();
    const std::string text = name + ", leaves of " + std::to_string(leaf_size);
    expect_same(bvh, WideTree(bvh), points_around(mesh), text);
    expect_same(bvh, WideTree(bvh, WideTree::Bounds::kBoxes), points_around(mesh), text + ", boxes");
  }
}

Mesh needles() {
  Mesh mesh = test::make_turned_torus(40, 20);
  for (Point& p : mesh.vertices) p = {1000 * p[0], p[1], 1e-6 * p[2]};
  return mesh;
}

TEST(WideTree, GivesTheHitsOfItsTree) {
  expect_same_trees(test::make_turned_torus(40, 20), "torus");
  expect_same_trees(test::make_box({1, 2, 3}), "box");
  expect_same_trees(test::make_l_shape(2, 0.6, 0.8), "L");
  expect_same_trees(needles(), "needles");
  Mesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  expect_same_trees(one, "one triangle");
}

TEST(WideTree, InAnyUnitAndPlace) {
  for (const double unit : {1e-140, 1e-30, 1e30, 1e140}) {
    Mesh mesh = test::make_turned_torus(30, 12);
    test::scale(mesh, unit);
    expect_same_trees(mesh, "unit " + std::to_string(std::log10(unit)));
  }
  Mesh far = test::make_turned_torus(30, 12);
  test::translate(far, {1e9, -1e9, 1e9});
  expect_same_trees(far, "far away");
}

TEST(WideTree, ManyTrianglesAtOnePlace) {
  Mesh mesh = test::make_box({1, 1, 1});
  const Mesh one = mesh;
  for (int i = 0; i < 20; ++i) test::append(mesh, one);
  expect_same_trees(mesh, "21 boxes at one place");
}

TEST(WideTree, OfOnePointAndForNoNumbers) {
  Mesh mesh = test::make_box({1, 1, 1});
  std::ranges::fill(mesh.vertices, Point{1, 2, 3});
  const Bvh bvh = Bvh::build(test::view_of(mesh), {4, 1}).value();
  const WideTree wide(bvh);
  EXPECT_EQ(wide.closest(bvh, {1, 2, 5}).squared_distance, 4);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wide.closest(bvh, {kNan, 0, 0}).triangle, BvhHit().triangle);
  EXPECT_EQ(wide.closest(bvh, {1, 2, 5}, 0).triangle, BvhHit().triangle);
  EXPECT_EQ(wide.closest(bvh, {1, 2, 5}, -1).triangle, BvhHit().triangle);
}

TEST(WideTree, FollowsARefit) {
  Mesh mesh = test::make_turned_torus(40, 20);
  Bvh bvh = Bvh::build(test::view_of(mesh), {4, 1}).value();
  WideTree wide(bvh);
  for (const test::Motion motion : test::kMotions) {
    Mesh moved = mesh;
    moved.vertices = test::moved_vertices(mesh.vertices, motion, 1);
    test::scale(moved, 3);
    ASSERT_TRUE(bvh.refit(test::view_of(moved)).ok());
    wide.refit(bvh);
    expect_same(bvh, wide, points_around(moved), test::name_of(motion));
  }
}

double distance_of(const Bvh& bvh, const Point& p, std::size_t position) {
  return std::sqrt(nearest_on_triangle(p, bvh.corners()[position]).squared_distance);
}

/// Limits exceed radii by less than 2^-18 of the lengths involved, and bounds of distances have errors below 2^-19 of
/// them: WideTree::Walk.
TEST(WideTree, GathersTheTrianglesWithinARadius) {
  const Mesh mesh = test::make_turned_torus(40, 20);
  const Bvh bvh = Bvh::build(test::view_of(mesh), {4, 1}).value();
  const WideTree wide(bvh);
  const BvhBox& box = bvh.nodes().front().box;
  std::vector<std::uint32_t> room(bvh.order().size());
  std::size_t missed = 0, beyond = 0, gathered = 0;
  for (const Point& p : points_around(mesh)) {
    const double far = length(box.upper - box.lower) + length(p - box.lower);
    for (const double factor : {0.9, 1.0 + 1e-12, 1.3}) {
      const double radius = factor * std::sqrt(bvh.closest(p).squared_distance) + 1e-12 * far;
      const std::optional<std::size_t> count = wide.gather(p, radius, room);
      if (!count) continue;  // too far for floats
      const std::set<std::uint32_t> found(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(*count));
      EXPECT_EQ(found.size(), *count);
      gathered += *count;
      for (std::uint32_t i = 0; i < bvh.order().size(); ++i) {
        missed += distance_of(bvh, p, i) <= radius && !found.contains(i) ? 1 : 0;
        beyond += distance_of(bvh, p, i) > radius + 0x1p-17 * far && found.contains(i) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_EQ(beyond, 0u);
  EXPECT_GT(gathered, 1000u);
}

TEST(WideTree, GathersNoneWithoutRoomForAll) {
  const Bvh bvh = Bvh::build(test::view_of(test::make_box({1, 1, 1})), {4, 1}).value();
  const WideTree wide(bvh);
  std::array<std::uint32_t, 12> room;
  EXPECT_EQ(wide.gather({0.5, 0.5, 0.5}, 2, room), 12u);
  EXPECT_EQ(wide.gather({0.5, 0.5, 0.5}, 2, std::span(room).first(11)), std::nullopt);
  EXPECT_EQ(wide.gather({1e20, 0, 0}, 1e21, room), std::nullopt);
  EXPECT_EQ(wide.gather({0.5, 0.5, 0.5}, 0.1, room), 0u);
}

}  // namespace
}  // namespace medial_vk
