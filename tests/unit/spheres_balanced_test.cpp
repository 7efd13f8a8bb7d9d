// Lines through a solid, what a ball adds to the symmetric difference, and the sets that make it small.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "medial_vk/ball_union.h"
#include "mesh/load_mesh.h"
#include "mesh/point_ops.h"
#include "spheres/approximate.h"
#include "spheres/best_method.h"
#include "spheres/dilation.h"
#include "spheres/measures.h"
#include "spheres/solid_lines.h"
#include "spheres/symmetric_difference.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

constexpr double kPi = std::numbers::pi;

struct Shape {
  explicit Shape(Mesh raw) : mesh(prepare_mesh(std::move(raw)).value()), solid(Solid::build(mesh).value()) {}
  Shape(const Shape&) = delete;

  std::vector<SphereSet> balanced(std::size_t count, bool levels = false) const {
    SphereRequest request;
    request.contract = SphereContract::kBalanced;
    request.count = count;
    if (levels) return approximate_in_levels(solid, request, Backend::kCpu, nullptr).value();
    return {approximate_by_spheres(solid, request, Backend::kCpu, nullptr).value()};
  }

  PreparedMesh mesh;
  Solid solid;
};

/// In ascending order.
std::vector<std::array<double, 4>> numbers_of(const std::vector<Ball>& balls) {
  std::vector<std::array<double, 4>> numbers;
  for (const Ball& b : balls) numbers.push_back({b.centre[0], b.centre[1], b.centre[2], b.radius});
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

double volume_of(const Ball& ball) { return 4 * kPi / 3 * ball.radius * ball.radius * ball.radius; }

double volume_along(const SolidLines& lines, std::size_t axis) {
  double sum = 0;
  for (const SolidLines::Stretch& part : lines.along(axis).inside) sum += part.to - part.from;
  return sum * lines.spacing() * lines.spacing();
}

/// A sum of lengths instead of their integral: the length changes by at most its greatest value, up and down again,
/// along a row of lines, and the area of a row so across the rows; a convex solid's volume is missed by no more than
/// two such changes of one spacing each.
double line_error(double area, double spacing) { return 4 * spacing * area; }

TEST(SolidLines, HaveTheVolumeOfABoxExactlyAlongEachAxis) {
  const Shape box(test::make_box({2, 1, 0.5}));
  const SolidLines lines(box.solid, 64);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidLines::Bundle& bundle = lines.along(axis);
    for (const SolidLines::Stretch& part : bundle.inside) {
      EXPECT_EQ(part.from, box.mesh.report.lower[axis]);
      EXPECT_EQ(part.to, box.mesh.report.upper[axis]);
    }
    const double across = 1 / (box.mesh.report.upper[axis] - box.mesh.report.lower[axis]);
    EXPECT_NEAR(volume_along(lines, axis), 1, lines.spacing() * 2 * (2 + 1) * across + 1e-12);
  }
}

TEST(SolidLines, PassEdgesAndVerticesOnce) {
  // Lines through the middles of the squares meet the diagonals of the faces, and vertices of a grid of triangles.
  for (const std::size_t per_side : {16u, 32u, 33u}) {
    const Shape torus(test::make_torus(1, 0.4, 32, 16));
    const SolidLines lines(torus.solid, per_side);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const SolidLines::Bundle& bundle = lines.along(axis);
      for (std::ptrdiff_t j = 0; j < bundle.count[1]; ++j) {
        for (std::ptrdiff_t i = 0; i < bundle.count[0]; ++i) {
          Point at{};
          at[bundle.across[0]] = bundle.first[0] + lines.spacing() * static_cast<double>(i);
          at[bundle.across[1]] = bundle.first[1] + lines.spacing() * static_cast<double>(j);
          for (const SolidLines::Stretch& part : bundle.stretches(i, j)) {
            at[axis] = 0.5 * (part.from + part.to);
            EXPECT_TRUE(torus.solid.contains(at));
            at[axis] = part.to + 1e-9;
            EXPECT_FALSE(torus.solid.contains(at));
            at[axis] = part.from - 1e-9;
            EXPECT_FALSE(torus.solid.contains(at));
          }
        }
      }
    }
  }
}

TEST(SolidLines, LeaveCavitiesOut) {
  Mesh shells = test::make_box({3, 3, 3});
  Mesh cavity = test::make_box({1, 1, 1});
  const auto first = static_cast<std::uint32_t>(shells.vertices.size());
  for (Point p : cavity.vertices) shells.vertices.push_back(p + Point{1, 1, 1});
  for (const Triangle& t : cavity.triangles) shells.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  const Shape shape(std::move(shells));
  ASSERT_TRUE(shape.solid.has_volume());
  const SolidLines lines(shape.solid, 60);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(volume_along(lines, axis), 26, line_error(9 + 1, lines.spacing()) * 3);
  }
}

TEST(SymmetricDifference, CountsABallInsideDownAndOneOutsideUp) {
  const Shape box(test::make_box({1, 1, 1}));
  SymmetricDifference difference(box.solid);
  const double spacing = SolidLines(box.solid, 160).spacing();
  const Ball inside = {{0.4, 0.5, 0.55}, 0.3};
  EXPECT_NEAR(difference.change(inside, {}), -volume_of(inside), line_error(kPi * 0.09, spacing));
  // Half of it outside: nothing is gained and nothing lost.
  const Ball half = {{1, 0.5, 0.5}, 0.2};
  EXPECT_NEAR(difference.change(half, {}), 0, line_error(kPi * 0.04, spacing));
  const std::vector<Ball> same = {inside};
  EXPECT_EQ(difference.change(inside, same), 0);
  const std::vector<Ball> larger = {{inside.centre, 0.35}};
  EXPECT_EQ(difference.change(inside, larger), 0);
}

TEST(SymmetricDifference, DoesNotDependOnTheOrder) {
  const Shape torus(test::make_turned_torus());
  SymmetricDifference difference(torus.solid);
  const Point middle = torus.mesh.report.lower + 0.5 * (torus.mesh.report.upper - torus.mesh.report.lower);
  std::vector<Ball> balls;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * 0.7;
    balls.push_back({middle + Point{0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.05 * k}, 0.3 + 0.03 * k});
  }
  const auto sum = [&] {
    double all = 0;
    for (std::size_t k = 0; k < balls.size(); ++k) all += difference.change(balls[k], {balls.data(), k});
    return all;
  };
  const double forwards = sum();
  std::reverse(balls.begin(), balls.end());
  EXPECT_NEAR(sum(), forwards, 1e-12);
}

/// Area of a sphere that the cube cuts off is 2 pi r (r - 1/2) at each face; half of the sphere is outside for r = 0.6.
TEST(BalancedSpheres, OneBallOfACubeIsHalfOutside) {
  const Shape cube(test::make_box({1, 1, 1}));
  const Ball ball = cube.balanced(1).back().balls.at(0);
  const auto difference = [](double r) {
    const double h = std::max(0.0, r - 0.5);
    return 1 - 4 * kPi / 3 * r * r * r + 12 * kPi * h * h * (3 * r - h) / 3;
  };
  const double estimate_error = line_error(kPi * 0.36, SolidLines(cube.solid, 160).spacing());
  EXPECT_LE(difference(ball.radius), difference(0.6) + 2 * estimate_error);
  EXPECT_NEAR(ball.radius, 0.6, 0.04);  // where that holds
}

TEST(BalancedSpheres, AreBetterThanBallsInsideAndThanTheSources) {
  const Shape shape(test::make_l_shape(2.0, 0.6, 0.8));
  SphereRequest request;
  request.count = 24;
  const SphereSet inside = approximate_by_spheres(shape.solid, request, Backend::kCpu, nullptr).value();
  const SphereSet dilated = dilate_to_boundary(shape.solid, inside).value();
  const auto error = [&](const SphereSet& set) { return measure_spheres(shape.solid, set.balls).value().volume; };
  const VolumeError balanced = error(shape.balanced(24).back());
  EXPECT_LT(balanced.normalized() + 6 * balanced.normalized_standard_error(), error(inside).normalized());
  EXPECT_LT(balanced.normalized() + 6 * balanced.normalized_standard_error(), error(dilated).normalized());
}

TEST(BalancedSpheres, MoreBallsAreNeverWorseAndLevelsAreTheAnswersForTheirNumbers) {
  const Shape shape(test::make_ellipsoid({2, 1, 0.6}, 24));
  const std::vector<SphereSet> levels = shape.balanced(32, true);
  ASSERT_EQ(levels.size(), 6u);
  SymmetricDifference difference(shape.solid);
  double before = 0;
  for (const SphereSet& level : levels) {
    double sum = 0;
    for (std::size_t k = 0; k < level.balls.size(); ++k) {
      sum += difference.change(level.balls[k], {level.balls.data(), k});
    }
    EXPECT_LT(sum, before) << level.balls.size();
    before = sum;
  }
  EXPECT_EQ(numbers_of(levels[3].balls), numbers_of(shape.balanced(8).back().balls));
}

/// Balls come and move, and what is left is kept count of: as if it were added up anew.
TEST(BalancedSpheres, MeetAnErrorByTheEstimateAndWithNoBallTooMany) {
  const Shape shape(test::make_l_shape(2.0, 0.6, 0.8));
  const auto left = [&](const std::vector<Ball>& balls) {
    SymmetricDifference difference(shape.solid);
    double sum = shape.solid.volume();
    for (std::size_t k = 0; k < balls.size(); ++k) sum += difference.change(balls[k], {balls.data(), k});
    return sum / shape.solid.volume();
  };
  SphereRequest request;
  request.contract = SphereContract::kBalanced;
  request.error = 0.15;
  const std::vector<Ball> balls = approximate_by_spheres(shape.solid, request, Backend::kCpu, nullptr).value().balls;
  EXPECT_LE(left(balls), 0.15 + 1e-9);
  EXPECT_GT(left(shape.balanced(balls.size() - 1).back().balls), 0.15 - 1e-9);
}

TEST(BalancedSpheres, OfAnOpenMeshAreBallsToo) {
  Mesh open = test::make_box({1, 1, 1});
  open.triangles.pop_back();
  const Shape shape(std::move(open));
  const std::vector<Ball> balls = shape.balanced(6).back().balls;
  EXPECT_EQ(balls.size(), 6u);
  for (const Ball& ball : balls) EXPECT_GT(ball.radius, 0);
}

}  // namespace
}  // namespace medial_vk
