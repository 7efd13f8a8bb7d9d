// Kinds, support and bounds of hulls, and their volumes against other formulas and against their meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"
#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

using std::numbers::pi;
using test::HullFamily;

double cube(double x) { return x * x * x; }

double volume_of_mesh(const Mesh& mesh) {
  double sum = 0;
  const Point& origin = mesh.vertices[0];
  for (const Triangle& t : mesh.triangles) {
    sum += dot(mesh.vertices[t[0]] - origin, cross(mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin)) / 6;
  }
  return sum;
}

/// The area of the box's surface: a convex body in it has at most that much.
double area_bound(const BallHull& hull) {
  const HullBounds bounds = bounds_of(hull);
  const Point size = bounds.upper - bounds.lower;
  return 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
}

TEST(BallHull, HasAKindAndItsNumbers) {
  const Ball a = {{0, 0, 0}, 1}, b = {{3, 0, 0}, 1}, c = {{3, 0, 0}, 0.5};
  EXPECT_EQ(kind_of(hull_of(a)), HullKind::kBall);
  EXPECT_EQ(kind_of(hull_of(a, b)), HullKind::kCapsule);
  EXPECT_EQ(kind_of(hull_of(a, c)), HullKind::kCone);
  EXPECT_EQ(kind_of(hull_of(a, b, c)), HullKind::kSlab);
  EXPECT_EQ(parameters_of(HullKind::kBall), 4u);
  EXPECT_EQ(parameters_of(HullKind::kCapsule), 7u);
  EXPECT_EQ(parameters_of(HullKind::kCone), 8u);
  EXPECT_EQ(parameters_of(HullKind::kSlab), 12u);
  EXPECT_EQ(hull_of(a, c).balls().size(), 2u);
}

TEST(BallHull, SupportAndBoundsAreThoseOfTheBalls) {
  const BallHull hull = hull_of({{0, 0, 0}, 1}, {{3, 0, 0}, 0.5}, {{0, 4, 1}, 0.25});
  EXPECT_DOUBLE_EQ(support(hull, {2, 0, 0}), 7);
  EXPECT_DOUBLE_EQ(support(hull, {-1, 0, 0}), 1);
  EXPECT_EQ(support_point(hull, {2, 0, 0}), (Point{3.5, 0, 0}));
  EXPECT_EQ(support_point(hull, {0, 0, 3}), (Point{0, 4, 1.25}));
  const HullBounds bounds = bounds_of(hull);
  EXPECT_EQ(bounds.lower, (Point{-1, -1, -1}));
  EXPECT_EQ(bounds.upper, (Point{3.5, 4.25, 1.25}));
  std::mt19937_64 random(1);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const BallHull other = test::random_hull(1 + i % 3, random);
    const Point direction = {std::sin(i * 1.0), std::cos(i * 3.0), std::sin(i * 7.0)};
    EXPECT_NEAR(dot(direction, support_point(other, direction)), support(other, direction), 1e-14);
    EXPECT_NEAR(signed_distance(other, support_point(other, direction)), 0, 1e-14);
  }
}

TEST(HullVolume, OfBallsCapsulesAndConesIsThatOfTextbooks) {
  EXPECT_NEAR(volume_of(hull_of({{1, 2, 3}, 0.5})), 4 * pi / 3 * cube(0.5), 1e-15);
  EXPECT_NEAR(volume_of(hull_of({{1, 2, 3}, 0.5}, {{1, 2, 7}, 0.5})), 4 * pi / 3 * cube(0.5) + pi * 0.25 * 4, 1e-14);
  // Two caps and a frustum. The cone touches each sphere at s r beside its centre, s = (2 - 0.5) / 3.
  const double s = 0.5, rise = 3 - s * 1.5, low = 2 * std::sqrt(0.75), high = 0.5 * std::sqrt(0.75);
  const auto cap = [](double radius, double height) { return pi * height * height * (3 * radius - height) / 3; };
  const double expected =
      cap(2, 2 + s * 2) + cap(0.5, 0.5 - s * 0.5) + pi * rise / 3 * (low * low + low * high + high * high);
  EXPECT_NEAR(volume_of(hull_of({{0, 0, 0}, 2}, {{0, 3, 0}, 0.5})), expected, 1e-13);
}

TEST(HullVolume, OfASlabOfOneRadiusIsSteiners) {
  const Point a = {0, 0, 0}, b = {2, 0, 0}, c = {0.5, 1.5, 0.25};
  const double area = length(cross(b - a, c - a)) / 2, border = length(b - a) + length(c - b) + length(a - c);
  for (const double r : {1e-6, 0.1, 1.0, 30.0}) {
    const double expected = 2 * r * area + pi / 2 * r * r * border + 4 * pi / 3 * cube(r);
    EXPECT_NEAR(volume_of(hull_of({a, r}, {b, r}, {c, r})), expected, 1e-14 * expected);
  }
}

TEST(HullVolume, WithoutRadiusIsNothing) {
  EXPECT_EQ(volume_of(hull_of({{1, 2, 3}, 0})), 0);
  EXPECT_EQ(volume_of(hull_of({{1, 2, 3}, 0}, {{3, 2, 3}, 0})), 0);
  EXPECT_EQ(volume_of(hull_of({{1, 2, 3}, 0}, {{3, 2, 3}, 0}, {{1, 1, 1}, 0})), 0);
  EXPECT_EQ(volume_of(hull_of({{1, 2, 3}, 0}, {{1, 2, 3}, 0}, {{1, 2, 3}, 0})), 0);
}

TEST(HullVolume, OfBallsInOtherBallsOrHullsIsThatOfTheRest) {
  const Ball a = {{0, 0, 0}, 1}, b = {{4, 0, 0}, 0.5}, in_a = {{0.25, 0.25, 0}, 0.5}, in_both = {{2, 0, 0}, 0.75};
  const double cone = volume_of(hull_of(a, b));
  EXPECT_DOUBLE_EQ(volume_of(hull_of(a, in_a)), 4 * pi / 3);
  EXPECT_DOUBLE_EQ(volume_of(hull_of(in_a, a, a)), 4 * pi / 3);
  EXPECT_DOUBLE_EQ(volume_of(hull_of(b, in_a, a)), cone);
  EXPECT_DOUBLE_EQ(volume_of(hull_of(in_both, a, b)), cone);
  EXPECT_DOUBLE_EQ(volume_of(hull_of(a, b, b)), cone);
}

// A ball between two others that is too great for a flat triangle: two cones at one ball.
TEST(HullVolume, OfAChainIsThatOfTwoCones) {
  const Ball first = {{-3, 0.5, 0}, 0.5}, middle = {{0, 0, 0}, 2}, last = {{3, 0.5, 0}, 0.25};
  const double expected = volume_of(hull_of(first, middle)) + volume_of(hull_of(middle, last)) - 4 * pi / 3 * 8;
  EXPECT_NEAR(volume_of(hull_of(first, middle, last)), expected, 1e-13);
  EXPECT_NEAR(volume_of(hull_of(middle, last, first)), expected, 1e-13);
}

// A mesh in the hull is smaller, by at most the tolerance times the surface of the box around the hull.
TEST(HullVolume, IsThatOfFineMeshes) {
  std::mt19937_64 random(3);
  int compared = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const BallHull hull = test::random_hull(1 + i % 3, random);
    const double volume = volume_of(hull), tolerance = 2e-4;
    const Result<Mesh> mesh = mesh_of(hull, tolerance);
    if (!mesh.ok()) continue;
    const double inside = volume_of_mesh(mesh.value());
    EXPECT_LE(inside, volume * (1 + 1e-12)) << "hull " << i;
    EXPECT_GE(inside, volume - tolerance * area_bound(hull)) << "hull " << i;
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

// A thinner triangle changes the volume continuously, through the hulls that are cones.
TEST(HullVolume, IsContinuousWhereTheShapeChanges) {
  std::mt19937_64 random(4);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto family = i % 2 == 0 ? HullFamily::kThin : HullFamily::kNearlyNested;
    const BallHull hull = test::random_hull(3, family, random);
    BallHull moved = hull;
    moved.corners[i % 3].radius += 1e-12;
    moved.corners[(i + 1) % 3].centre[0] += 1e-12;
    // The surface moves by at most 2e-12; rounding may leave out a ball that reaches out by 2^-46 of the size.
    EXPECT_NEAR(volume_of(moved), volume_of(hull), 3e-12 * area_bound(hull)) << "hull " << i;
  }
}

TEST(HullVolume, DoesNotDependOnTheOrder) {
  std::mt19937_64 random(9);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const BallHull hull = test::random_hull(3, random);
    const auto& [a, b, c] = hull.corners;
    const double volume = volume_of(hull);
    EXPECT_NEAR(volume_of(hull_of(b, c, a)), volume, 1e-13 * area_bound(hull)) << "hull " << i;
    EXPECT_NEAR(volume_of(hull_of(c, b, a)), volume, 1e-13 * area_bound(hull)) << "hull " << i;
  }
}

}  // namespace
}  // namespace medial_vk
