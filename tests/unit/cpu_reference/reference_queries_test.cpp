// The reference's queries against slower or closed-form answers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "cpu_reference/queries.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"
#include "unit/cpu_reference/random.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Feature;

Mesh bumpy_solid() {
  Mesh mesh = test::make_cup(1.0, 0.3, 1.2, 24);
  test::rotate(mesh, {0.3, 0.5, 0.8}, 0.7);
  return mesh;
}

/// Distance to a triangle by golden sections over both weights: slow, but independent of the code under test.
double searched_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto minimum = [](const auto& f) {
    double low = 0, high = 1;
    for (int i = 0; i < 90; ++i) {
      const double x = low + (high - low) * 0.381966, y = low + (high - low) * 0.618034;
      (f(x) < f(y) ? high : low) = f(x) < f(y) ? y : x;
    }
    return std::min({f(0), f(1), f((low + high) / 2)});
  };
  return minimum([&](double s) {
    const Vector3d from = a + s * (b - a), to = a + s * (c - a);
    return minimum([&](double t) { return (p - (from + t * (to - from))).norm(); });
  });
}

TEST(ReferenceTriangle, AgreesWithASearch) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = random.point(1), b = random.point(1), c = random.point(1), p = random.point(2);
    const auto here = reference::closest_point_on_triangle(p, a, b, c);
    EXPECT_NEAR(std::sqrt(here.squared_distance), searched_distance(p, a, b, c), 1e-7);
  }
}

TEST(ReferenceTriangle, SurvivesNeedlesAndPoints) {
  Random random(1);
  for (double width : {1e-3, 1e-7, 1e-11, 1e-15, 0.0}) {
    for (int i = 0; i < 200; ++i) {
      const Vector3d a = random.point(1), b = random.point(1), off = random.point(1) * width, p = random.point(2);
      const double t = random(-0.2, 1.2);
      const Vector3d c = a + t * (b - a) + off;
      const auto here = reference::closest_point_on_triangle(p, a, b, c);
      // Within the needle's width of the nearest of its three edges.
      double edges = 1e9;
      for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        const double s = std::clamp((p - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0);
        edges = std::min(edges, (p - u - s * (v - u)).norm());
      }
      EXPECT_LE(std::sqrt(here.squared_distance), edges + 1e-15);
      EXPECT_GE(std::sqrt(here.squared_distance), edges - 2 * width - 1e-14);
    }
  }
  const Vector3d a(1, 2, 3);
  EXPECT_DOUBLE_EQ(reference::closest_point_on_triangle({1, 2, 5}, a, a, a).squared_distance, 4.0);
}

TEST(ReferenceTriangle, NamesTheFeature) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(reference::closest_point_on_triangle({0.2, 0.2, 1}, a, b, c).feature, Feature::kFace);
  EXPECT_EQ(reference::closest_point_on_triangle({0.4, -1, 1}, a, b, c).feature, Feature::kEdge);
  EXPECT_EQ(reference::closest_point_on_triangle({1, 1, 0}, a, b, c).feature, Feature::kEdge);
  EXPECT_EQ(reference::closest_point_on_triangle({-1, -1, 0}, a, b, c).feature, Feature::kVertex);
  EXPECT_EQ(reference::closest_point_on_triangle({3, -1, 0}, a, b, c).feature, Feature::kVertex);
}

TEST(ReferenceTree, AgreesWithAllTriangles) {
  const reference::Mesh mesh = test::to_reference(bumpy_solid());
  const reference::Tree tree(mesh);
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random.point(2);
    double best = 1e9;
    int nearest = -1;
    std::vector<int> within;
    const double radius = random(0, 1.5);
    for (int t = 0; t < tree.triangle_count(); ++t) {
      const double d2 = tree.closest_on(t, p).squared_distance;
      if (d2 < best) best = d2, nearest = t;
      if (d2 <= radius * radius) within.push_back(t);
    }
    best = std::sqrt(best);
    const reference::Closest found = tree.closest(p);
    EXPECT_EQ(found.triangle, nearest);
    EXPECT_EQ(found.distance, best);
    EXPECT_NEAR((found.point - p).norm(), best, 1e-15);
    std::vector<int> gathered = tree.gather(p, radius);
    std::sort(gathered.begin(), gathered.end());
    EXPECT_EQ(gathered, within);
    EXPECT_EQ(tree.ball_is_empty(p, radius), best >= radius);
    EXPECT_TRUE(tree.ball_is_empty(p, best * (1 - 1e-12)));
    EXPECT_FALSE(tree.ball_is_empty(p, best * (1 + 1e-12) + 1e-15));
  }
}

TEST(ReferenceWinding, IsOneInsideZeroOutside) {
  const reference::Mesh mesh = test::to_reference(test::make_box({1, 2, 3}));
  const reference::Tree tree(mesh);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = random.point(3.5);
    const bool inside = (p.array() > 0).all() && p.x() < 1 && p.y() < 2 && p.z() < 3;
    EXPECT_NEAR(reference::winding_number(tree, p), inside ? 1 : 0, 1e-12);
    EXPECT_EQ(reference::is_inside(tree, p), inside);
  }
}

TEST(ReferenceWinding, FastFormKeepsItsTolerance) {
  Mesh cup = bumpy_solid();
  cup.triangles.resize(cup.triangles.size() * 3 / 4);  // open: winding numbers are not whole
  const reference::Tree tree(test::to_reference(cup));
  Random random(1);
  for (double tolerance : {0.2, 0.01, 1e-4}) {
    for (int i = 0; i < 300; ++i) {
      const Vector3d p = random.point(3);
      const double exact = reference::winding_number(tree, p);
      EXPECT_NEAR(reference::winding_number(tree, p, tolerance), exact, tolerance);
      EXPECT_EQ(reference::is_inside(tree, p), exact >= 0.5);
    }
  }
}

TEST(ReferenceFlux, SpiralPointsAreSpreadEvenly) {
  for (int n : {50, 100, 200, 400}) {
    const std::vector<Vector3d> points = reference::spiral_points(n);
    Vector3d sum = Vector3d::Zero();
    double nearest_least = 9;
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(points[i].norm(), 1, 1e-14);
      sum += points[i];
      for (int j = 0; j < i; ++j) nearest_least = std::min(nearest_least, (points[i] - points[j]).norm());
    }
    EXPECT_LT(sum.norm() / n, 0.02);
    EXPECT_GT(nearest_least, 1.9 / std::sqrt(n));  // latitudes start 2 / sqrt(n) from the poles
  }
}

TEST(ReferenceFlux, OppositeIsTheOtherIntersection) {
  const Vector3d centre(1, 2, 3), p = centre + Vector3d(0, 0, 2), direction = Vector3d(1, 2, -2) / 3;
  const Vector3d q = reference::opposite(centre, p, direction);
  EXPECT_NEAR((q - centre).norm(), 2, 1e-14);
  EXPECT_NEAR((q - p).cross(direction).norm(), 0, 1e-14);
  EXPECT_EQ(reference::opposite(centre, p, Vector3d(1, 0, 0)), p);
}

// A slab's middle plane through the centre: the gradient is +-z, its flux the mean of |cos| = 1/2 = sin(pi/2) / 2.
TEST(ReferenceFlux, OfAPlanarSheetIsHalfSine) {
  const reference::Tree tree(test::to_reference(test::make_box({10, 10, 2})));
  const auto directions = reference::spiral_points(400);
  const reference::Flux through = reference::outward_flux(tree, {5, 5, 1}, 0.25, directions);
  EXPECT_NEAR(through.average, 0.5, 0.01);
  EXPECT_EQ(through.fans, 0);
  EXPECT_NEAR(through.greatest_distance, 1, 1e-3);
  EXPECT_NEAR(reference::outward_flux(tree, {5, 5, 0.5}, 0.25, directions).average, 0, 0.01);
}

TEST(ReferenceFlux, LeavesOutTwoSidedFans) {
  // Seen from outside, the corner of a box is nearest to a whole region: no medial surface, all samples are fans.
  const reference::Tree tree(test::to_reference(test::make_box({1, 1, 1})));
  const reference::Flux flux = reference::outward_flux(tree, {-2, -2, -2}, 0.25, reference::spiral_points(100));
  EXPECT_EQ(flux.fans, 100);
  EXPECT_EQ(flux.average, 0);
}

TEST(ReferenceRetract, FindsTheMiddleOfASlab) {
  const reference::Tree tree(test::to_reference(test::make_box({10, 10, 2})));
  const double epsilon = 1e-4;
  const reference::Retraction r = reference::retract(tree, {5.1, 5.2, 0.3}, {5.1, 5.2, 1.6}, epsilon);
  EXPECT_NEAR(r.p.z(), 1, epsilon);
  EXPECT_LE((r.p - r.q).norm(), epsilon);
  EXPECT_NEAR(r.radius, 1, epsilon);
  EXPECT_NEAR(reference::half_angle(r.spoke_p, r.spoke_q), std::numbers::pi / 2, 1e-12);
}

}  // namespace
}  // namespace medial_vk
