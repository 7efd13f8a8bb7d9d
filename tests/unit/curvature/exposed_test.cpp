// Spokes from the parts of balls that no other ball covers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "ball_unions/cells/ball_tree.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/unions/unit_balls.h"
#include "curvature/exposed_spokes.h"
#include "medial_vk/ball_union.h"
#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

using test::BallSheet;

double angle_to(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

std::vector<ExposedSpokes> exposed_spokes_of_all(const std::vector<Ball>& balls, double spacing, unsigned threads = 1) {
  std::vector<std::uint32_t> numbers(balls.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  return exposed_spokes(SheetLinks(balls, spacing, 1), numbers, threads, {});
}

/// The balls of a prism along y over an equilateral triangle with the inradius 1: three sheets from its axis to its
/// edges. The normals of its sides are 60 degrees from the direction of each edge.
struct TrianglePrism {
  std::vector<Ball> balls;
  std::vector<std::uint8_t> is_on_axis;
  std::array<Point, 3> normals;

  explicit TrianglePrism(double spacing = 0.05) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 3;
      normals[k] = {-std::cos(angle), 0, -std::sin(angle)};
      test::scatter(0.6, 1, spacing, [&](double u, double v) {
        const double out = u + 0.6;
        balls.push_back({{out * std::cos(angle), v, out * std::sin(angle)}, 1 - out / 2});
        is_on_axis.push_back(out < 0.02 ? 1 : 0);
      });
    }
  }
  double off(const Point& spoke) const {
    double least = std::numbers::pi;
    for (const Point& normal : normals) least = std::min(least, angle_to(normal, spoke));
    return least;
  }
  /// Each centre by up to `most` along each axis; each ball remains as large as it can be inside.
  void move(double most) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> by(-most, most);
    for (Ball& ball : balls) {
      for (double& x : ball.centre) x += by(random);
      ball.radius = 1 - dot(ball.centre, normals[0]);
      for (const Point& normal : normals) ball.radius = std::min(ball.radius, 1 - dot(ball.centre, normal));
    }
  }
  /// The normals of the sides that a ball touches, up to rounding.
  std::vector<Point> contacts(const Ball& ball) const {
    std::vector<Point> out;
    for (const Point& normal : normals) {
      if (1 - dot(ball.centre, normal) <= ball.radius * (1 + 1e-14)) out.push_back(normal);
    }
    return out;
  }
};

/// Whether it is in the cone around the region, up to rounding.
bool may_hold(const ExposedRegion& region, const Point& contact) {
  return angle_to(contact, region.direction) <= region.reach + 1e-7;
}

TEST(ExposedRegions, HaveTheAreasAndVectorsOfTheUnion) {
  BallSheet sheet = test::spheroid(2, 1, 0.2);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> noise(-0.01, 0.01);
  for (Ball& ball : sheet.balls) {
    ball.radius += noise(random);
    ball.centre[2] += noise(random);
  }
  const BallUnion measured = measure_ball_union(sheet.balls, BallUnionOptions{}).value();
  const std::vector<Ball> scaled = scaled_balls(sheet.balls, scale_of(sheet.balls));
  const BallTree tree(scaled, 1);
  CellBuilder builder(scaled, tree);
  RegionFinder finder;
  std::array<std::size_t, 3> counts = {};
  for (std::uint32_t i = 0; i < scaled.size(); ++i) {
    const auto regions = finder.find(builder.build(i), scaled[i].radius);
    ++counts[std::min<std::size_t>(regions.size(), 2)];
    double area = 0;
    Point vector = {0, 0, 0};
    for (const ExposedRegion& region : regions) {
      area += region.area;
      vector = vector + region.vector;
      EXPECT_LE(length(region.vector), region.area * (1 + 1e-9));
    }
    // Sums of some tens of terms of the size of a sphere.
    const double square = sheet.balls[i].radius * sheet.balls[i].radius;
    EXPECT_NEAR(area, measured.areas[i] / square, 1e-10) << i;
    EXPECT_LT(length(vector - 1 / square * measured.vectors[i]), 1e-10) << i;
  }
  EXPECT_GT(counts[1], 10u);
  EXPECT_GT(counts[2], 10u);
}

TEST(ExposedRegions, HoldTheContactsOfBallsInASolid) {
  constexpr double kSpacing = 0.05;
  const BallSheet sheet = test::spheroid(2, 1, kSpacing);
  const std::vector<ExposedSpokes> found = exposed_spokes_of_all(sheet.balls, kSpacing);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].count < 2) continue;
    ++pairs;
    for (const Point& contact : {sheet.spokes[i].a, sheet.spokes[i].b}) {
      const bool in_first = angle_to(contact, found[i].spokes[0]) <= found[i].reaches[0] + 1e-7;
      const bool in_second = angle_to(contact, found[i].spokes[1]) <= found[i].reaches[1] + 1e-7;
      EXPECT_TRUE(in_first != in_second) << i;
    }
  }
  EXPECT_GT(pairs, 9 * sheet.balls.size() / 10);
}

// A ball beside its sheet touches one side alone. Its contact is in a region whichever of the other balls count.
TEST(ExposedRegions, HoldTheContactsOfBallsBesideTheirSheets) {
  constexpr double kSpacing = 0.05;
  TrianglePrism prism(kSpacing);
  prism.move(0.05 * kSpacing);
  const std::vector<Ball> scaled = scaled_balls(prism.balls, scale_of(prism.balls));
  const BallTree tree(scaled, 1);
  BallMask half(tree);
  std::mt19937_64 random(2);
  for (std::uint32_t i = 0; i < scaled.size(); ++i) half.set(i, random() % 2 == 0);
  CellBuilder among_all(scaled, tree), among_half(scaled, tree, &half);
  RegionFinder finder;
  std::size_t held = 0;
  for (std::uint32_t i = 0; i < scaled.size(); ++i) {
    const std::vector<Point> contacts = prism.contacts(prism.balls[i]);
    ASSERT_EQ(contacts.size(), 1u) << i;
    for (CellBuilder* builder : {&among_all, &among_half}) {
      const auto regions = finder.find(builder->build(i), scaled[i].radius);
      if (regions.empty()) continue;  // so it is where no two caps cross
      ++held;
      EXPECT_TRUE(std::ranges::any_of(regions, [&](const ExposedRegion& r) { return may_hold(r, contacts[0]); })) << i;
    }
  }
  EXPECT_GT(held, 19 * scaled.size() / 10);
}

TEST(ExposedRegions, SpokesDoNotDependOnThreads) {
  TrianglePrism prism;
  prism.move(0.0025);
  const auto one = exposed_spokes_of_all(prism.balls, 0.05, 1), three = exposed_spokes_of_all(prism.balls, 0.05, 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].count, three[i].count) << i;
    EXPECT_EQ(one[i].spokes, three[i].spokes) << i;
    EXPECT_EQ(one[i].reaches, three[i].reaches) << i;
  }
}

TEST(ExposedRegions, ABallWithOneNeighbourHasNone) {
  const std::vector<Ball> pair = {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0.2, 0, 0}, 0.5}};
  for (const ExposedSpokes& spokes : exposed_spokes_of_all(pair, 1e-3)) EXPECT_EQ(spokes.count, 0u);
}

TEST(CurvatureOfExposedTips, SeamsHaveSpokes) {
  const TrianglePrism prism;
  const BoundaryCurvature result = measure_curvature(prism.balls).value();
  std::size_t exposed = 0, with_curvature = 0;
  for (std::size_t i = 0; i < prism.balls.size(); ++i) {
    const bool is_inner = std::fabs(prism.balls[i].centre[1]) < 0.6;
    for (const TipCurvature& tip : result.balls[i].tips) {
      if (prism.is_on_axis[i] != 0 && is_inner) {
        EXPECT_EQ(tip.state, CurvatureState::kExposed) << i;
      }
      if (tip.state != CurvatureState::kExposed || !is_inner) continue;
      ++exposed;
      EXPECT_LE(prism.off(tip.normal), tip.normal_error + 1e-9) << i;
      if (std::isnan(tip.kappa[0])) continue;
      ++with_curvature;
      // The sides are flat, and the tips around it are exact up to rounding.
      EXPECT_LT(std::fabs(tip.kappa[0]) + std::fabs(tip.kappa[1]), 1e-6) << i;
    }
  }
  EXPECT_GT(exposed, 100u);
  EXPECT_GT(with_curvature, exposed / 2);
}

TEST(CurvatureOfExposedTips, SparseBallsHaveSpokesAlone) {
  const BallSheet plate = test::flat_plate({0, 0, 1}, 20, 5, 1);
  CurvatureOptions options;
  options.spacing = 0.05;
  const BoundaryCurvature result = measure_curvature(plate.balls, options).value();
  std::size_t exposed = 0;
  for (const BallCurvature& ball : result.balls) {
    for (const TipCurvature& tip : ball.tips) {
      if (tip.state != CurvatureState::kExposed) continue;
      ++exposed;
      EXPECT_GE(std::fabs(tip.normal[2]), std::cos(tip.normal_error) - 1e-12);
      EXPECT_TRUE(std::isnan(tip.kappa[0]) && std::isnan(tip.error));
    }
  }
  EXPECT_GT(exposed, 600u);  // of 800; balls at the border of the plate are exposed in one region
}

}  // namespace
}  // namespace medial_vk
