// Boxes in float around points: whatever the points, none is outside.
#include "proximity/boxes/boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stop_token>
#include <vector>

#include "medial_vk/prepare.h"
#include "proximity/surface_tree.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Exact = long double;
using ExactPoint = std::array<Exact, 3>;

Exact determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <class Number>
ExactPoint exact(const std::array<Number, 3>& p) {
  return {p[0], p[1], p[2]};
}

/// The greatest |s_i| of p = c + s_1 e_1 + s_2 e_2 + s_3 e_3, by Cramer's rule. Its error is some 2^-60 of |p - c| /
/// |e_i|, while the box is larger than the points by more than 2^-22 of its size, and by 2^-48 of |c|.
Exact share_of(const FloatBox& box, const ExactPoint& p) {
  const ExactPoint c = exact(box.centre), away = {p[0] - c[0], p[1] - c[1], p[2] - c[2]};
  if (away == ExactPoint{0, 0, 0}) return 0;  // also in the box of a point at the origin, which has no edges
  const std::array<ExactPoint, 3> e = {exact(box.half_edges[0]), exact(box.half_edges[1]), exact(box.half_edges[2])};
  const Exact whole = determinant(e[0], e[1], e[2]);
  return std::max({std::fabs(determinant(away, e[1], e[2]) / whole), std::fabs(determinant(e[0], away, e[2]) / whole),
                   std::fabs(determinant(e[0], e[1], away) / whole)});
}

struct Cloud {
  std::vector<Point> points;
  Point normal;
};

/// Of one to forty points, often in a plane, on a line or at one place, of sizes from 1e-9 to 1e18, near the origin or
/// far away from it.
Cloud random_cloud(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> exponent(-9, 17), flat(-12, 0);
  const auto vector = [&] { return Point{normal(random), normal(random), normal(random)}; };
  const std::array<Point, 3> axes = {vector(), vector(), vector()};
  const double size = std::pow(10, exponent(random));
  std::array<double, 3> sizes = {size, size, size};
  for (double& s : sizes) s *= random() % 3 == 0 ? 0 : random() % 2 == 0 ? std::pow(10, flat(random)) : 1;
  const double far = random() % 2 == 0 ? 0 : size * std::pow(10, -flat(random) / 2);
  const Point middle = far * vector();
  Cloud cloud;
  for (std::size_t i = 0, count = 1 + random() % 40; i < count; ++i) {
    Point p = middle;
    for (std::size_t k = 0; k < 3; ++k) p = p + (sizes[k] * normal(random)) * axes[k];
    cloud.points.push_back(p);
  }
  cloud.normal = random() % 4 == 0 ? Point{0, 0, 0} : random() % 2 == 0 ? vector() : cross(axes[0], axes[1]);
  return cloud;
}

TEST(Boxes, HoldTheirPoints) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const Cloud cloud = random_cloud(seed);
    const FloatBox box = box_around(cloud.points, cloud.normal);
    for (const Point& p : cloud.points) ASSERT_LE(share_of(box, exact(p)), 1) << "seed " << seed;
  }
}

/// What errors of planes are derived from (nearest_triangles.cpp).
TEST(Boxes, ReachNotMuchFartherThanTheirPoints) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const Cloud cloud = random_cloud(seed);
    const FloatBox box = box_around(cloud.points, cloud.normal);
    double farthest = 0;
    for (const Point& p : cloud.points) farthest = std::max(farthest, length(p));
    const auto size = [](const std::array<float, 3>& v) { return length({v[0], v[1], v[2]}); };
    const double reach = size(box.centre) + size(box.half_edges[0]) + size(box.half_edges[1]) + size(box.half_edges[2]);
    ASSERT_LE(reach, 3.001 * farthest) << "seed " << seed;
  }
}

FloatBox box_of(const EightBoxes& boxes, std::size_t k) {
  FloatBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.centre[axis] = boxes.centre[axis][k];
    for (std::size_t edge = 0; edge < 3; ++edge) box.half_edges[edge][axis] = boxes.half_edges[edge][axis][k];
  }
  return box;
}

/// Checks that the boxes of a node and of all below it hold their triangles, and adds these to `triangles`. Returns
/// the number of boxes.
std::size_t check_boxes(const SurfaceTree& tree, std::uint32_t index, const Point& centre,
                        std::vector<std::uint32_t>& triangles) {
  const BodyNode& node = tree.nodes().node(index);
  if (node.is_lowest) {
    triangles.insert(triangles.end(), node.below.begin(), node.below.begin() + node.count);
    return 0;
  }
  std::size_t boxes = node.count;
  for (std::uint32_t k = 0; k < node.count; ++k) {
    std::vector<std::uint32_t> below;
    boxes += check_boxes(tree, node.below[k], centre, below);
    const FloatBox box = box_of(tree.boxes(index), k);
    for (const std::uint32_t t : below) {
      for (const Point& corner : tree.corners(t)) {
        const ExactPoint p = exact(corner), c = exact(centre);
        EXPECT_LE(share_of(box, {p[0] - c[0], p[1] - c[1], p[2] - c[2]}), 1) << "triangle " << t;
      }
    }
    triangles.insert(triangles.end(), below.begin(), below.end());
  }
  return boxes;
}

TEST(Boxes, OfATreeHoldTheirTriangles) {
  for (const double far : {0.0, 1e3, 1e9}) {
    Mesh mesh = test::make_torus(0.5, 0.02, 60, 20);
    test::translate(mesh, {far, -far / 3, far / 7});
    const Result<Solid> solid = Solid::build(test::indexed(prepare_mesh(mesh).value()));
    ASSERT_TRUE(solid);
    const Point centre = {far + 0.1, -far / 3, far / 7};
    const ProgressCallback progress;
    const std::stop_token stop;
    LoopWatch watch(progress, stop);
    const SurfaceTree tree = SurfaceTree::build(solid.value(), centre, 1, watch);
    std::vector<std::uint32_t> triangles;
    EXPECT_GT(check_boxes(tree, 0, centre, triangles), tree.size() / 8);
    EXPECT_EQ(triangles.size(), tree.size());
  }
}

/// A flat piece gets a flat box, so that planes separate it from what lies before it.
TEST(Boxes, AreFlatWherePointsAre) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> aside(-1, 1);
  const Point normal = {2.0 / 3, -1.0 / 3, 2.0 / 3}, x = perpendicular_to(normal), y = cross(normal, x);
  std::vector<Point> points;
  for (int i = 0; i < 100; ++i) points.push_back(3 * normal + aside(random) * x + 0.1 * aside(random) * y);
  const FloatBox box = box_around(points, normal);
  std::array<double, 3> half = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& e = box.half_edges[i];
    half[i] = length({e[0], e[1], e[2]});
  }
  EXPECT_LE(half[0], 1e-5);
  EXPECT_LE(half[1] + half[2], 1.3);
}

}  // namespace
}  // namespace medial_vk
