// The greatest radii of hulls with given centres, in solids where they are known, and by distances of the reference.
#include "hull_fits/search/free_radii.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/ball_hulls.h"
#include "support/hulls/random_hulls.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

constexpr double kDepth = 1e-8, kThinnest = 1e-4;

/// By how much the deepest triangle is in a hull, by the dual of the reference.
double reference_depth(const Shape& shape, const BallHull& hull) {
  double deepest = 0;
  const Mesh& mesh = shape.mesh.mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const BallHull flat = hull_of(Ball{mesh.vertices[a], 0}, Ball{mesh.vertices[b], 0}, Ball{mesh.vertices[c], 0});
    deepest = std::max(deepest, -reference::hull_distance(test::reference_hull(hull), test::reference_hull(flat)));
  }
  return deepest;
}

/// Of coordinates up to 2.
constexpr double kOfDistances = 1e-13;

std::vector<Mesh> some_solids() {
  return {test::make_box({1, 0.7, 0.45}), test::make_l_shape(1, 0.4, 0.3), test::make_plate_with_hole(1, 0.1, 0.5),
          test::make_sphere(0.5, 80)};
}

TEST(FreeRadii, LeaveNoTriangleDeeperThanTheTolerance) {
  std::mt19937_64 random(36);
  int fitted = 0, refused = 0;
  for (const Mesh& mesh : some_solids()) {
    const Shape shape(mesh);
    const FreeRadii radii(shape.solid, kThinnest, kDepth);
    const Point &lower = shape.mesh.report.lower, &upper = shape.mesh.report.upper;
    for (int i = 0; i < 300; ++i) {
      std::array<Point, 3> centres = {};
      for (Point& centre : centres) {
        for (std::size_t k = 0; k < 3; ++k) {
          centre[k] = std::uniform_real_distribution<double>(lower[k], upper[k])(random);
        }
      }
      const auto count = 1 + static_cast<std::uint32_t>(i % 3);
      const bool equal = i % 2 == 0;
      const std::optional<BallHull> hull = radii.fit(centres, count, equal);
      if (!hull) {
        ++refused;
        continue;
      }
      ++fitted;
      EXPECT_EQ(hull->count, count);
      EXPECT_TRUE(shape.solid.contains(centres[0]));
      for (std::uint32_t k = 0; k < count; ++k) {
        EXPECT_EQ(hull->corners[k].centre, centres[k]);
        EXPECT_GE(hull->corners[k].radius, kThinnest * (1 - 1e-12));
        EXPECT_LE(hull->corners[k].radius, shape.solid.distance(centres[k]) * (1 + 1e-12));
        if (equal) {
          EXPECT_EQ(hull->corners[k].radius, hull->corners[0].radius);
        }
      }
      const double depth = reference_depth(shape, *hull);
      EXPECT_LE(depth, kDepth + kOfDistances) << i;
      EXPECT_NEAR(std::max(0.0, radii.greatest_depth(*hull)), depth, kDepth) << i;
    }
  }
  EXPECT_GT(fitted, 200);
  EXPECT_GT(refused, 100);
}

// If one radius alone could be greater, the sum would not be the greatest.
TEST(FreeRadii, AreTheGreatest) {
  std::mt19937_64 random(37);
  const Shape shape(test::make_l_shape(1, 0.4, 0.3));
  const FreeRadii radii(shape.solid, kThinnest, kDepth);
  int fitted = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<Point, 3> centres = {};
    for (Point& centre : centres) {
      centre = {std::uniform_real_distribution<double>(0, 0.8)(random),
                std::uniform_real_distribution<double>(0, 0.4)(random),
                std::uniform_real_distribution<double>(0, 0.3)(random)};
    }
    const auto count = 1 + static_cast<std::uint32_t>(i % 3);
    const std::optional<BallHull> hull = radii.fit(centres, count, false);
    if (!hull) continue;
    ++fitted;
    for (std::uint32_t k = 0; k < count; ++k) {
      BallHull larger = *hull;
      larger.corners[k].radius += 1e-4;
      EXPECT_GT(reference_depth(shape, larger), kDepth + kOfDistances) << "radius " << k << " of hull " << i;
    }
  }
  EXPECT_GT(fitted, 60);
}

BallHull fit_of(const Shape& shape, const std::array<Point, 3>& centres, std::uint32_t count, bool equal) {
  const std::optional<BallHull> hull = FreeRadii(shape.solid, kThinnest, kDepth).fit(centres, count, equal);
  EXPECT_TRUE(hull);
  return hull.value_or(BallHull{});
}

TEST(FreeRadii, OfAPlateAreHalfItsThickness) {
  const Shape plate(test::make_box({2, 2, 0.2}));
  const std::array<Point, 3> middle = {{{0.5, 0.5, 0.1}, {1.5, 0.5, 0.1}, {0.5, 1.5, 0.1}}};
  for (std::uint32_t count = 1; count <= 3; ++count) {
    for (const bool equal : {false, true}) {
      const BallHull hull = fit_of(plate, middle, count, equal);
      for (const Ball& ball : hull.balls()) EXPECT_NEAR(ball.radius, 0.1, kDepth) << count;
    }
  }
  // Beside the middle, and near a side.
  const std::array<Point, 3> beside = {{{0.5, 0.5, 0.06}, {1.5, 0.5, 0.13}, {0.5, 1.96, 0.1}}};
  const BallHull slab = fit_of(plate, beside, 3, false);
  EXPECT_NEAR(slab.corners[0].radius, 0.06, kDepth);
  EXPECT_NEAR(slab.corners[1].radius, 0.07, kDepth);
  EXPECT_NEAR(slab.corners[2].radius, 0.04, kDepth);
  const BallHull equal = fit_of(plate, beside, 3, true);
  for (const Ball& ball : equal.balls()) EXPECT_NEAR(ball.radius, 0.04, kDepth);
}

TEST(FreeRadii, OfABoxReachItsSides) {
  const Shape box(test::make_box({1, 1, 3}));
  const BallHull cone = fit_of(box, {{{0.5, 0.5, 0.5}, {0.5, 0.25, 2.5}, {}}}, 2, false);
  EXPECT_NEAR(cone.corners[0].radius, 0.5, kDepth);
  EXPECT_NEAR(cone.corners[1].radius, 0.25, kDepth);
}

// The edge of the notch is at (0.4, 0.4), at 0.05 / sqrt(2) from the line x + y = 0.75.
TEST(FreeRadii, KeepClearOfTheEdgeOfANotch) {
  const Shape solid(test::make_l_shape(1, 0.4, 0.3));
  const std::array<Point, 3> across = {{{0.55, 0.2, 0.15}, {0.2, 0.55, 0.15}, {0.2, 0.2, 0.15}}};
  const double clearance = 0.05 / std::sqrt(2.0);
  const BallHull capsule = fit_of(solid, across, 2, true);
  EXPECT_NEAR(capsule.corners[0].radius, clearance, kDepth);
  const BallHull cone = fit_of(solid, across, 2, false);
  EXPECT_GE(cone.corners[0].radius + cone.corners[1].radius, 2 * clearance - 2 * kDepth);
  const BallHull slab = fit_of(solid, across, 3, false);
  EXPECT_NEAR(slab.corners[2].radius, 0.15, kDepth);
  // Centres that do not see each other, though the solid holds both, and the axis is longer than the wall is thick.
  const FreeRadii radii(solid.solid, kThinnest, kDepth);
  EXPECT_FALSE(radii.fit({{{0.9, 0.2, 0.15}, {0.2, 0.9, 0.15}, {}}}, 2, false));
  EXPECT_FALSE(radii.fit({{{0.9, 0.2, 0.15}, {0.2, 0.9, 0.15}, {0.2, 0.2, 0.15}}}, 3, true));
}

TEST(FreeRadii, RefuseAxesAcrossTheBoundary) {
  Mesh two = test::make_box({1, 1, 1});
  test::append(two, test::moved(test::make_box({1, 1, 1}), {1.0 + 1e-6, 0, 0}));
  const Shape apart(two);
  const FreeRadii radii(apart.solid, kThinnest, kDepth);
  EXPECT_TRUE(radii.fit({{{0.5, 0.5, 0.5}, {0.5, 0.6, 0.5}, {}}}, 2, false));
  EXPECT_FALSE(radii.fit({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {}}}, 2, false));
  EXPECT_FALSE(radii.fit({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 0.2, 0.5}}}, 3, false));
  EXPECT_FALSE(radii.fit({{{-0.5, 0.5, 0.5}, {}, {}}}, 1, false)) << "outside";
  EXPECT_FALSE(radii.fit({{{0.5, 0.5, 1e-5}, {}, {}}}, 1, false)) << "nearer than the least radius";
}

// By no node is a triangle left out that is deeper.
TEST(NodeSlabs, HoldAllTrianglesOfANode) {
  std::mt19937_64 random(38);
  int beside = 0;
  for (const Mesh& mesh : some_solids()) {
    const Shape shape(mesh);
    const Bvh& bvh = shape.solid.bvh();
    const NodeSlabs slabs(bvh);
    for (int i = 0; i < 60; ++i) {
      BallHull hull = test::random_hull(1 + static_cast<std::uint32_t>(i % 3), random);
      for (Ball& ball : hull.corners) ball = {0.5 * ball.centre, 0.3 * ball.radius};
      const double tolerance = i % 2 == 0 ? 0 : 0.01;
      for (std::size_t n = 0; n < bvh.nodes().size(); ++n) {
        const BvhNode& node = bvh.nodes()[n];
        if (node.count == 0 || !slabs.beside(n, hull, tolerance)) continue;
        ++beside;
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
          const auto& [a, b, c] = bvh.corners()[t];
          const BallHull flat = hull_of(Ball{a, 0}, Ball{b, 0}, Ball{c, 0});
          const double distance = reference::hull_distance(test::reference_hull(hull), test::reference_hull(flat));
          EXPECT_GE(distance, -tolerance - kOfDistances);
        }
      }
      // An inner node that is beside has only children that hold nothing deeper.
      if (!slabs.beside(0, hull, tolerance)) continue;
      EXPECT_LE(reference_depth(shape, hull), tolerance + kOfDistances);
    }
  }
  EXPECT_GT(beside, 500);
}

}  // namespace
}  // namespace medial_vk
