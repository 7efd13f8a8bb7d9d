// Lines through a solid, the contribution of a ball to the symmetric difference, and sets that reduce it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/methods/approximate.h"
#include "sphere_fits/methods/best_method.h"
#include "sphere_fits/methods/dilation.h"
#include "sphere_fits/quality/measures.h"
#include "sphere_fits/steps/solid_lines.h"
#include "sphere_fits/steps/symmetric_difference.h"
#include "support/indexed.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

/// The numbers of the balls, in ascending order.
std::vector<std::array<double, 4>> numbers_of(const std::vector<Ball>& balls) {
  std::vector<std::array<double, 4>> numbers;
  for (const Ball& b : balls) numbers.push_back({b.centre[0], b.centre[1], b.centre[2], b.radius});
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

double volume_of(const Ball& ball) { return 4 * std::numbers::pi / 3 * ball.radius * ball.radius * ball.radius; }

double volume_along(const SolidLines& lines, std::size_t axis) {
  const SolidLines::Bundle& bundle = lines.along(axis);
  double sum = 0;
  for (const SolidLines::Stretch& part : bundle.inside) sum += part.to - part.from;
  return sum * bundle.spacing[0] * bundle.spacing[1];
}

/// A sum of lengths instead of their integral: the length changes by at most its greatest value, up and down again,
/// along a row of lines, and so does the area of a row across the rows; the error of a convex solid's volume is no more
/// than two such changes of one spacing each.
double line_error(double area, double spacing) { return 4 * spacing * area; }

TEST(SolidLines, HaveTheVolumeOfABoxExactlyAlongEachAxis) {
  const Point size = {2, 1, 0.003};  // of the last side less than a spacing
  const Shape box(test::make_box(size));
  const SolidLines lines(box.solid, 64, 8);
  const double whole = size[0] * size[1] * size[2];
  EXPECT_NEAR(lines.volume(), whole, 1e-12 * whole);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidLines::Bundle& bundle = lines.along(axis);
    for (const SolidLines::Stretch& part : bundle.inside) {
      // Three quotients, three products and two sums, each rounded by half a unit of at most the greatest coordinate.
      EXPECT_NEAR(part.from, box.mesh.report.lower[axis], 8 * 0x1p-53 * size[axis]);
      EXPECT_NEAR(part.to, box.mesh.report.upper[axis], 8 * 0x1p-53 * size[axis]);
    }
    EXPECT_NEAR(volume_along(lines, axis), whole, 1e-12 * whole);
  }
}

TEST(SolidLines, PassEdgesAndVerticesOnce) {
  // Lines through the middles of the squares meet the diagonals of the faces, and vertices of a grid of triangles.
  for (const std::size_t per_side : {16u, 32u, 33u}) {
    const Shape torus(test::make_torus(1, 0.4, 32, 16));
    const SolidLines lines(torus.solid, per_side, 4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const SolidLines::Bundle& bundle = lines.along(axis);
      for (std::ptrdiff_t j = 0; j < bundle.count[1]; ++j) {
        for (std::ptrdiff_t i = 0; i < bundle.count[0]; ++i) {
          Point at{};
          at[bundle.across[0]] = bundle.at(0, i);
          at[bundle.across[1]] = bundle.at(1, j);
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
  const SolidLines lines(shape.solid, 60, 4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(volume_along(lines, axis), 26, line_error(9 + 1, 3.0 / 60) * 3);
  }
}

TEST(SymmetricDifference, CountsABallInsideDownAndOneOutsideUp) {
  const Shape box(test::make_box({1, 1, 1}));
  SymmetricDifference difference(box.solid);
  const double spacing = 1.0 / 160;
  EXPECT_NEAR(difference.of_none(), 1, 1e-12);
  const Ball inside = {{0.4, 0.5, 0.55}, 0.3};
  EXPECT_NEAR(difference.change(inside, {}), -volume_of(inside), line_error(std::numbers::pi * 0.09, spacing));
  // Half of it outside: neither gain nor loss.
  const Ball half = {{1, 0.5, 0.5}, 0.2};
  EXPECT_NEAR(difference.change(half, {}), 0, line_error(std::numbers::pi * 0.04, spacing));
  const std::vector<Ball> same = {inside};
  EXPECT_EQ(difference.change(inside, same), 0);
  const std::vector<Ball> larger = {{inside.centre, 0.35}};
  EXPECT_EQ(difference.change(inside, larger), 0);
}

/// The length of the line on which exactly one of the solid and the union is, between all ends one after the other.
double difference_on_line(std::span<const SolidLines::Stretch> inside, const std::vector<SolidLines::Stretch>& balls) {
  std::vector<double> ends;
  for (const SolidLines::Stretch& part : inside) ends.insert(ends.end(), {part.from, part.to});
  for (const SolidLines::Stretch& part : balls) ends.insert(ends.end(), {part.from, part.to});
  std::sort(ends.begin(), ends.end());
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double middle = 0.5 * (ends[k] + ends[k + 1]);
    const auto holds = [&](const SolidLines::Stretch& part) { return part.from < middle && middle < part.to; };
    if (std::any_of(inside.begin(), inside.end(), holds) != std::any_of(balls.begin(), balls.end(), holds))
      sum += ends[k + 1] - ends[k];
  }
  return sum;
}

/// What SymmetricDifference estimates, over every line that the balls can meet.
double difference_along_lines(const SolidLines& lines, const std::vector<Ball>& balls) {
  constexpr std::ptrdiff_t kBeyond = 80;
  double all = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidLines::Bundle& bundle = lines.along(axis);
    double sum = 0;
    for (std::ptrdiff_t j = -kBeyond; j < bundle.count[1] + kBeyond; ++j) {
      for (std::ptrdiff_t i = -kBeyond; i < bundle.count[0] + kBeyond; ++i) {
        std::vector<SolidLines::Stretch> parts;
        for (const Ball& ball : balls) {
          const double x = bundle.at(0, i) - ball.centre[bundle.across[0]];
          const double y = bundle.at(1, j) - ball.centre[bundle.across[1]];
          const double squared = ball.radius * ball.radius - x * x - y * y;
          if (squared <= 0) continue;
          parts.push_back({ball.centre[axis] - std::sqrt(squared), ball.centre[axis] + std::sqrt(squared)});
        }
        sum += difference_on_line(bundle.stretches(i, j), parts);
      }
    }
    all += sum * bundle.spacing[0] * bundle.spacing[1] / 3;
  }
  return all;
}

TEST(SymmetricDifference, IsThatOfAllLinesBeforeAndAfterAStep) {
  const Shape torus(test::make_turned_torus());
  SymmetricDifference difference(torus.solid);
  const SolidLines lines(torus.solid, 160, 32);
  const Point middle = torus.mesh.report.lower + 0.5 * (torus.mesh.report.upper - torus.mesh.report.lower);
  const auto ball = [&](double x, double y, double z, double radius) { return Ball{middle + Point{x, y, z}, radius}; };
  // Some hold most of the moving ball, some cut its stretches in the middle, and one is far from it.
  const std::vector<Ball> others = {ball(0.5, 0.1, 0, 0.3),    ball(0.55, 0.2, 0.1, 0.25), ball(0.3, 0.5, 0, 0.2),
                                    ball(0.45, 0, 0.35, 0.05), ball(0.5, 0, -0.3, 0.04),   ball(-0.6, 0, 0, 0.3)};
  const std::vector<std::array<Ball, 2>> steps = {
      {ball(0.5, 0, 0, 0.35), ball(0.52, 0.03, -0.02, 0.33)},  // a small step
      {ball(0.5, 0, 0, 0.3), ball(0.5, 0, 0, 0.4)},            // growth
      {ball(0.5, 0, 0, 0.35), ball(-0.2, 0.1, 0.6, 0.15)},     // away from where it was
      {ball(0.5, 0, 0, 0.35), ball(0.5, 0, 0, 0.001)},         // almost nothing remains
      {ball(0.5, 0, 0, 0.2), ball(0.5, 0.1, 0, 0.2)},          // hidden before and after, but for a cap
  };
  for (const auto& [from, to] : steps) {
    std::vector<Ball> before = others, after = others;
    before.push_back(from);
    after.push_back(to);
    const double expected = difference_along_lines(lines, after) - difference_along_lines(lines, before);
    // Sums of 10^5 lengths of at most 1, each rounded by some 2^-52.
    EXPECT_NEAR(difference.change(from, to, others), expected, 1e5 * 8 * 0x1p-52);
  }
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

/// The area of a sphere that the cube cuts off is 2 pi r (r - 1/2) at each face; half of the sphere is outside for r =
/// 0.6.
TEST(BalancedSpheres, OneBallOfACubeIsHalfOutside) {
  const Shape cube(test::make_box({1, 1, 1}));
  const Ball ball = cube.balanced(1).back().balls.at(0);
  const auto difference = [](double r) {
    const double h = std::max(0.0, r - 0.5);
    return 1 - 4 * std::numbers::pi / 3 * r * r * r + 12 * std::numbers::pi * h * h * (3 * r - h) / 3;
  };
  const double estimate_error = line_error(std::numbers::pi * 0.36, 1.0 / 160);
  EXPECT_LE(difference(ball.radius), difference(0.6) + 2 * estimate_error);
  EXPECT_NEAR(ball.radius, 0.6, 0.04);  // the radius for which that holds
}

TEST(BalancedSpheres, AreBetterThanBallsInsideAndThanTheSources) {
  const Shape shape(test::make_l_shape(2.0, 0.6, 0.8));
  SphereFitOptions request;
  request.count = 24;
  const SphereSet inside = approximate_by_spheres(shape.solid, request, reference_extractor()).value();
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

/// One of the boxes is thinner than the spacing of lines.
TEST(BalancedSpheres, MeetAnErrorThatIsMeasuredOtherwise) {
  for (const Point& size : {Point{1, 0.8, 0.6}, Point{1, 0.02, 0.006}}) {
    const Shape box(test::make_box(size));
    SphereFitOptions request;
    request.contract = SphereContract::kBalanced;
    request.error = 0.25;
    const std::vector<Ball> balls = approximate_by_spheres(box.solid, request, reference_extractor()).value().balls;
    MeasureOptions other;
    other.seed = 7;  // other samples than those of the search
    const VolumeError error = estimate_volume_error(box.solid, balls, other).value();
    EXPECT_LE(error.normalized(), 0.25 + 8 * error.normalized_standard_error());
    EXPECT_LE(measure_spheres(box.solid, balls).value().volume.normalized(), 0.25);  // as reported
    request.count = balls.size();
    request.error = 0;
    request.contract = SphereContract::kInside;
    const SphereSet inside = approximate_by_spheres(box.solid, request, reference_extractor()).value();
    EXPECT_GT(measure_spheres(box.solid, inside.balls).value().volume.normalized(), 0.25);
  }
}

TEST(BalancedSpheres, LevelsOfAnErrorAreHalves) {
  const Shape box(test::make_box({1, 1, 1}));
  SphereFitOptions request;
  request.contract = SphereContract::kBalanced;
  request.error = 0.2;
  const std::vector<SphereSet> levels = approximate_in_levels(box.solid, request, reference_extractor()).value();
  ASSERT_GT(levels.size(), 2u);
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    EXPECT_EQ(levels[k].balls.size(), levels[k + 1].balls.size() / 2);
  }
  EXPECT_LE(measure_spheres(box.solid, levels.back().balls).value().volume.normalized(), 0.2);
}

TEST(BalancedSpheres, OfAnOpenMeshAreRefused) {
  Mesh open = test::make_box({1, 1, 1});
  open.triangles.pop_back();
  const Shape shape(std::move(open));
  SphereFitOptions request;
  request.contract = SphereContract::kBalanced;
  request.count = 6;
  EXPECT_EQ(approximate_by_spheres(shape.solid, request, reference_extractor()).error().code, ErrorCode::kUsage);
  request.method = SphereMethod::kSource;
  EXPECT_TRUE(approximate_by_spheres(shape.solid, request, reference_extractor()).ok());
}

}  // namespace
}  // namespace medial_vk
