// Hulls in the digits and shapes of other formats: what is written lies in the hull.
#include "output/hull_files/inner_shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include "base/point_ops.h"
#include "support/hulls/hull_samples.h"

namespace medial_vk {
namespace {

/// The middle of the hulls, their size, and the digits.
class InnerShapes : public testing::TestWithParam<std::tuple<double, double, Digits>> {
 protected:
  double size() const { return std::get<1>(GetParam()); }
  Digits digits() const { return std::get<2>(GetParam()); }
  Point far_away() const { return {std::get<0>(GetParam()), -2 * std::get<0>(GetParam()), 0}; }

  /// The origin of a file, in these digits.
  Point origin() const {
    Point at = far_away();
    for (double& x : at) x = in_digits(x + 0.1 * size(), digits());
    return at;
  }
  std::vector<BallHull> hulls() const { return test::sample_hulls(120, far_away(), size(), 7); }

  /// More than the digits lose, by about ten.
  double given_up() const { return (digits() == Digits::kFloat ? 1e-5 : 1e-12) * size() + 1e-12 * length(far_away()); }

  bool has_digits(double x) const { return in_digits(x, digits()) == x; }
};

/// The directions of the three axes by a quaternion, as the specification of glTF has them, which does not normalise.
std::array<Point, 3> columns_of(const std::array<double, 4>& q) {
  const auto& [x, y, z, w] = q;
  return {Point{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Point{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Point{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

std::array<double, 4> normalised(std::array<double, 4> q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= length;
  return q;
}

/// The greatest signed distance from a hull of points of the sphere with its centre at `along` of the axis y.
double farthest_of_end(const BallHull& hull, const Point& middle, const std::array<double, 4>& q, double along,
                       double radius, std::mt19937_64& random) {
  const std::array<Point, 3> axes = columns_of(q);
  std::normal_distribution<double> normal;
  double farthest = -INFINITY;
  for (int i = 0; i < 40; ++i) {
    Point u = {0, 0, 0};
    for (double& x : u) x = normal(random);
    if (i == 0) u = {0, 1, 0};
    if (i == 1) u = {0, -1, 0};
    const Point p = (radius / length(u)) * u + Point{0, along, 0};
    const Point at = middle + p[0] * axes[0] + p[1] * axes[1] + p[2] * axes[2];
    farthest = std::max(farthest, signed_distance(hull, at));
  }
  return farthest;
}

TEST_P(InnerShapes, MeshesLieInTheirHulls) {
  for (const BallHull& hull : hulls()) {
    const Result<Mesh> mesh = inner_mesh(hull, origin(), digits(), 0.02);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    ASSERT_FALSE(mesh.value().triangles.empty());
    double greatest = 0;
    for (const Ball& ball : hull.balls()) greatest = std::max(greatest, ball.radius);
    double depth = 0;
    for (const Point& v : mesh.value().vertices) {
      for (const double x : v) ASSERT_TRUE(has_digits(x));
      const double outside = signed_distance(hull, origin() + v);
      ASSERT_LE(outside, 0);
      depth = std::max(depth, -outside);
    }
    // All vertices are near the surface: a mesh that is too small would pass what is above.
    ASSERT_LT(depth, 0.02 * greatest + given_up());
  }
}

TEST_P(InnerShapes, CapsulesLieInTheirHulls) {
  std::mt19937_64 random(3);
  for (const BallHull& given : hulls()) {
    const BallHull hull = without_held_balls(given);
    if (hull.count != 2) continue;
    const std::optional<PosedCapsule> posed = posed_capsule(hull, origin(), digits());
    ASSERT_TRUE(posed.has_value());
    for (const double x : posed->middle) ASSERT_TRUE(has_digits(x));
    for (const double x : posed->rotation) ASSERT_TRUE(has_digits(x));
    for (const double x : {posed->height, posed->radius_bottom, posed->radius_top}) ASSERT_TRUE(has_digits(x));
    for (const auto& q : {posed->rotation, normalised(posed->rotation)}) {
      const Point middle = origin() + posed->middle;
      const double half = posed->height / 2;
      ASSERT_LE(farthest_of_end(hull, middle, q, half, posed->radius_top, random), 0);
      ASSERT_LE(farthest_of_end(hull, middle, q, -half, posed->radius_bottom, random), 0);
    }
    // Nothing is given up but what the digits lose.
    const double lost =
        std::max(hull.corners[0].radius, hull.corners[1].radius) - std::max(posed->radius_bottom, posed->radius_top);
    ASSERT_LT(lost, given_up());
  }
}

INSTANTIATE_TEST_SUITE_P(Places, InnerShapes,
                         testing::Combine(testing::Values(0, 1000), testing::Values(1, 1e-3),
                                          testing::Values(Digits::kDouble, Digits::kFloat)));

TEST(InnerShapes, BothReadingsOfRadiiLieInTheHull) {
  int written = 0;
  for (const BallHull& given : test::sample_hulls(600, {0, 0, 0}, 1, 11)) {
    const BallHull hull = without_held_balls(given);
    if (hull.count != 2) continue;
    const std::optional<BallHull> both = for_both_readings(hull);
    if (!both) continue;
    ++written;
    const Ball &a = both->corners[0], &b = both->corners[1];
    const double height = length(b.centre - a.centre);
    const Point along = (1 / height) * (b.centre - a.centre);
    // Radii of the balls at the ends, or of the rims of the cone, whose tangent balls are larger and beyond: up to the
    // rounding of these few operations.
    constexpr double kRounding = 1e-14;
    EXPECT_LE(signed_distance(hull, a.centre) + a.radius, kRounding);
    EXPECT_LE(signed_distance(hull, b.centre) + b.radius, kRounding);
    const double slope = (a.radius - b.radius) / height, secant = std::sqrt(1 + slope * slope);
    EXPECT_LE(signed_distance(hull, a.centre - slope * a.radius * along) + a.radius * secant, kRounding);
    EXPECT_LE(signed_distance(hull, b.centre - slope * b.radius * along) + b.radius * secant, kRounding);
    // The smaller ball stays, of the larger one at most half is given up.
    const double larger = std::max(hull.corners[0].radius, hull.corners[1].radius);
    EXPECT_GE(std::max(a.radius, b.radius), larger / 2);
    EXPECT_EQ(std::min(a.radius, b.radius), std::min(hull.corners[0].radius, hull.corners[1].radius));
  }
  EXPECT_GT(written, 200);
}

TEST(InnerShapes, BallsThatOthersHoldAreLeftOut) {
  const Ball large = {{0, 0, 0}, 1}, held = {{0.25, 0, 0}, 0.5}, other = {{2, 0, 0}, 1};
  EXPECT_EQ(without_held_balls(hull_of(large, held)).count, 1u);
  EXPECT_EQ(without_held_balls(hull_of(held, large)).corners[0].radius, 1);
  EXPECT_EQ(without_held_balls(hull_of(large, large, large)).count, 1u);
  const BallHull two = without_held_balls(hull_of(held, large, other));
  ASSERT_EQ(two.count, 2u);
  EXPECT_EQ(two.corners[1].centre, other.centre);
  EXPECT_EQ(without_held_balls(hull_of(large, other)).count, 2u);
}

TEST(InnerShapes, RadiiThatDoNotSufficeAreErrors) {
  const BallHull thin = hull_of({{1e6 + 0.01, 0, 0}, 1e-3}, {{1e6 + 3, 0, 0}, 1e-3});
  EXPECT_FALSE(posed_capsule(thin, {0, 0, 0}, Digits::kFloat).has_value());
  EXPECT_TRUE(posed_capsule(thin, {1e6, 0, 0}, Digits::kFloat).has_value());
  EXPECT_FALSE(inner_mesh(thin, {0, 0, 0}, Digits::kFloat, 0.01).ok());
  EXPECT_TRUE(inner_mesh(thin, {0, 0, 0}, Digits::kDouble, 0.01).ok());
  EXPECT_FALSE(shrunk(hull_of({{0, 0, 0}, 1}, {{1, 0, 0}, 0}), 0).has_value());
}

}  // namespace
}  // namespace medial_vk
