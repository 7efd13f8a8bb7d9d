// The triangulation is regular, with any ties and hidden balls, and its cells are those that are cut ball by ball.
#include "ball_unions/triangulation/regular_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/cells/cell_simplices.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

struct Family {
  std::string name;
  std::vector<Ball> balls;
  bool is_decided = true;  ///< No rounding decides whether a face meets a ball.
};

std::vector<Ball> duplicated(std::vector<Ball> balls) {
  balls.insert(balls.end(), balls.begin(), balls.end());
  return balls;
}

std::vector<Ball> one_far_away(std::size_t count) {
  auto balls = test::random_balls(count, 10, 0.02, 0.1);
  balls.push_back({{3000, 3000, 3000}, 1});
  return balls;
}

/// Few positions for many balls, moved a little or not at all, some of them twice; in one to three dimensions,
/// anywhere, of any size; radii alike, of four kinds, of all sizes, or such that spheres meet in a point.
std::vector<Ball> difficult(unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto below = [&](unsigned count) { return static_cast<unsigned>(engine() % count); };
  const auto fraction = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53); };
  const unsigned count = 1 + below(200), positions = 1 + below(6), dimensions = 1 + below(3), kind = below(4);
  const double noise = below(3) != 0 ? std::pow(10.0, -1 - static_cast<int>(below(17))) : 0;
  const double size = std::pow(10.0, static_cast<int>(below(9)) - 4);
  const Point shift = {below(2) != 0 ? 1000 * fraction() : 0, below(2) != 0 ? fraction() : 0, 0};
  std::vector<Ball> balls;
  for (unsigned n = 0; n < count; ++n) {
    Point c = {0, 0, 0};
    for (std::size_t k = 0; k < dimensions; ++k) c[k] = below(positions) + noise * (fraction() - 0.5);
    double radius = kind == 0   ? 1
                    : kind == 1 ? 0.5 * below(4)
                    : kind == 2 ? 2 * fraction()
                                : std::pow(10, -3 * fraction());
    if (kind < 2) radius = std::max(0.0, radius + noise * (fraction() - 0.5));
    if (kind == 3 && below(2) != 0) radius = length(c - Point{2, 2, 2});
    balls.push_back({size * (c + shift), size * radius});
    if (below(10) == 0) balls.push_back(balls.back());
  }
  return balls;
}

std::vector<Family> with_difficult_ones(std::vector<Family> families) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    families.push_back({"difficult " + std::to_string(seed), difficult(seed), false});
  }
  return families;
}

std::vector<Family> families() {
  return with_difficult_ones({
      {"none", {}},
      {"one", {{{1, 2, 3}, 0.5}}},
      {"one without an extent", {{{0, 0, 0}, 0}}},
      {"one without an extent anywhere", {{{1, 2, 3}, 0}}},
      {"one, tiny", {{{1, 2, 3}, 1e-17}}},
      {"one, tinier", {{{1, 2, 3}, 0x1p-90}}},
      {"two, tiny", {{{0, 0.5, 0}, 0x1p-72}, {{0x1p-70, 0.5, 0}, 0x1p-72}}},
      {"one far away", one_far_away(500)},
      {"random", test::random_balls(2000, 1, 0.02, 0.1)},
      {"overlapping", test::random_balls(400, 2, 0.2, 0.6)},
      {"lattice", test::lattice(9, 0.9)},
      {"nearly a lattice", test::lattice(9, 0.9, 1e-14)},
      {"touching", test::lattice(6, 0.5)},
      {"nearly touching", test::lattice(6, 0.5 * (1 - 3e-13))},
      {"flat lattice", test::flat_lattice(25, 2.25)},
      {"through a point", test::through_a_point(150, 3, true)},
      {"through a point, on one side", test::through_a_point(150, 4, false)},
      {"collinear", test::collinear(60, 5)},
      {"of all sizes", test::of_all_sizes(400, 6)},
      {"concentric", test::concentric(50, 7)},
      {"on a plane", test::on_a_plane(300, 8)},
      {"cospherical", test::cospherical(300, 0.4)},
      {"duplicated", duplicated(test::lattice(4, 0.8))},
  });
}

/// At a vertex where many spheres meet, rounding decides which edges of which cells end in it, but not the position of
/// the vertex. Spheres within 2^-36 touch, so it may move by the root of that along a sphere.
bool all_near(const std::vector<EnvelopeVertex>& vertices, const std::vector<EnvelopeVertex>& others) {
  return std::all_of(vertices.begin(), vertices.end(), [&](const EnvelopeVertex& vertex) {
    return std::any_of(others.begin(), others.end(),
                       [&](const EnvelopeVertex& other) { return length(vertex.at - other.at) < 0x1p-18; });
  });
}

RegularTriangulation triangulate(const std::vector<Ball>& balls) {
  return RegularTriangulation::build(balls, BallTree(balls, 2).order(), 2).value();
}

class RegularTriangulationOf : public testing::TestWithParam<Family> {
 protected:
  const std::vector<Ball> balls_ = scaled_balls(GetParam().balls, scale_of(GetParam().balls));
  const RegularTriangulation triangulation_ = triangulate(balls_);
  std::vector<Wall> no_walls_;
  ExactSide exact_{triangulation_.balls(), no_walls_};
};

TEST_P(RegularTriangulationOf, IsAComplexOfTetrahedraTheRightWayRound) {
  const auto tetrahedra = triangulation_.tetrahedra();
  std::size_t outer_faces = 0;
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    const auto& [balls, neighbours] = tetrahedra[t];
    ASSERT_EQ(exact_.orientation(balls[0], balls[1], balls[2], balls[3]), 1);
    for (std::size_t k = 0; k < 4; ++k) {
      if (neighbours[k] == RegularTriangulation::kNone) {
        ++outer_faces;
        continue;
      }
      const auto& other = tetrahedra[neighbours[k]];
      const auto back = std::find(other.neighbours.begin(), other.neighbours.end(), t) - other.neighbours.begin();
      ASSERT_LT(back, 4);
      std::multiset<std::uint32_t> here(balls.begin(), balls.end()), there(other.balls.begin(), other.balls.end());
      here.erase(balls[k]);
      there.erase(other.balls[static_cast<std::size_t>(back)]);
      ASSERT_EQ(here, there);
    }
  }
  EXPECT_EQ(outer_faces, 4u);  // of the four far points
}

/// Locally, which suffices: the lifted faces are then a convex surface.
TEST_P(RegularTriangulationOf, IsRegular) {
  const auto tetrahedra = triangulation_.tetrahedra();
  for (const auto& tetrahedron : tetrahedra) {
    const auto& balls = tetrahedron.balls;
    for (const std::uint32_t next : tetrahedron.neighbours) {
      if (next == RegularTriangulation::kNone) continue;
      for (const std::uint32_t apex : tetrahedra[next].balls) {
        if (std::find(balls.begin(), balls.end(), apex) != balls.end()) continue;
        const auto name = [&](std::size_t k) { return static_cast<std::int32_t>(balls[k]); };
        ASSERT_TRUE(exact_.keeps(balls[0], name(1), name(2), name(3), static_cast<std::int32_t>(apex)));
      }
    }
  }
}

/// Nothing is missing from the cell and from its part in the ball, and nothing is added: hidden balls included.
TEST_P(RegularTriangulationOf, HasTheCellsThatAreCutBallByBall) {
  const BallTree tree(balls_, 2);
  CellBuilder builder(balls_, tree);
  PowerCell cell(triangulation_.balls());
  SimplexCollector collector;
  DualComplex here, there;
  std::vector<EnvelopeVertex> vertices_here, vertices_there;
  for (const std::uint32_t i : tree.order()) {
    const Ball& ball = balls_[i];
    if (ball.radius == 0) continue;
    cell.start(i, triangulation_);
    cell.sharpen();
    const PowerCell& expected = builder.build(i);
    const BallInCell a = measure_ball_in_cell(cell, ball.radius), b = measure_ball_in_cell(expected, ball.radius);
    // The errors of both are roundings of a few dozen terms of at most 4 pi r^3 / 3 and 4 pi r^2 (ball_in_cell.cpp),
    // and displacements of corners by up to 2^-40 r.
    EXPECT_NEAR(a.volume, b.volume, 0x1p-38 * std::pow(ball.radius, 3)) << "ball " << i;
    EXPECT_NEAR(a.area, b.area, 0x1p-36 * std::pow(ball.radius, 2)) << "ball " << i;
    collector.collect(cell, ball, here, vertices_here);
    collector.collect(expected, ball, there, vertices_there);
  }
  make_complete(here, vertices_here);
  make_complete(there, vertices_there);
  if (!GetParam().is_decided) return;
  EXPECT_EQ(here.vertices, there.vertices);
  EXPECT_EQ(here.edges, there.edges);
  EXPECT_EQ(here.triangles, there.triangles);
  EXPECT_EQ(here.tetrahedra, there.tetrahedra);
  EXPECT_TRUE(all_near(vertices_here, vertices_there));
  EXPECT_TRUE(all_near(vertices_there, vertices_here));
}

TEST_P(RegularTriangulationOf, FindsTheStarOfEveryBall) {
  const auto tetrahedra = triangulation_.tetrahedra();
  std::size_t listed = 0;
  for (std::uint32_t i = 0; i < triangulation_.balls().size(); ++i) {
    const auto star = triangulation_.around(i);
    listed += star.size();
    for (std::uint32_t n = 0; n < star.size(); ++n) {
      const auto& balls = tetrahedra[star[n]].balls;
      const auto k = std::find(balls.begin(), balls.end(), i) - balls.begin();
      ASSERT_LT(k, 4);
      ASSERT_EQ(triangulation_.position_around(star[n], static_cast<std::size_t>(k)), n);
    }
  }
  EXPECT_EQ(listed, 4 * tetrahedra.size());
}

INSTANTIATE_TEST_SUITE_P(Families, RegularTriangulationOf, testing::ValuesIn(families()), [](const auto& family) {
  std::string name = family.param.name;
  std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
  return name;
});

/// Balls in general position: another order of insertion gives the same tetrahedra.
TEST(RegularTriangulation, DoesNotDependOnTheOrderOfBalls) {
  const auto balls = test::random_balls(500, 9, 0.05, 0.2);
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::reverse(order.begin(), order.end());
  std::vector<Ball> reversed;
  reversed.reserve(balls.size());
  for (const std::uint32_t i : order) reversed.push_back(balls[i]);
  const auto tetrahedra_of = [](const RegularTriangulation& triangulation, const auto& name) {
    std::set<std::multiset<std::uint32_t>> all;
    for (const auto& t : triangulation.tetrahedra()) {
      std::multiset<std::uint32_t> names;
      for (const std::uint32_t i : t.balls) names.insert(triangulation.is_far(i) ? i : name(i));
      all.insert(names);
    }
    return all;
  };
  const auto here = tetrahedra_of(triangulate(balls), [](std::uint32_t i) { return i; });
  const auto there = tetrahedra_of(triangulate(reversed), [&](std::uint32_t i) { return order[i]; });
  EXPECT_EQ(here, there);
  EXPECT_GT(here.size(), balls.size());
}

/// Two rods that pass each other far apart: every ball of one is joined to every ball of the other.
std::vector<Ball> two_rods(std::size_t count) {
  std::vector<Ball> balls;
  for (std::size_t n = 0; n < count; ++n) {
    const double x = (static_cast<double>(n) - 0.5 * static_cast<double>(count)) / static_cast<double>(count);
    balls.push_back({{x, 0, 0}, 0.75 / static_cast<double>(count)});
    balls.push_back({{0, x, 1}, 0.75 / static_cast<double>(count)});
  }
  return balls;
}

TEST(RegularTriangulation, IsGivenUpWhereItIsTooLargeAndVolumesStayRight) {
  const auto many = two_rods(1000), few = two_rods(50);
  EXPECT_FALSE(RegularTriangulation::build(many, BallTree(many, 1).order(), 1).has_value());
  EXPECT_TRUE(RegularTriangulation::build(few, BallTree(few, 1).order(), 1).has_value());
  for (const auto& balls : {many, few}) {
    // Balls of radius r at steps of 4 r / 3 along a line: cut at 2 r / 3 from their centres.
    const std::size_t n = balls.size() / 2;
    const double r = balls[0].radius, h = 2 * r / 3, pi = std::numbers::pi;
    const double cap = pi * (r - h) * (r - h) * (2 * r + h) / 3;
    const double rod = static_cast<double>(n) * 4 * pi * r * r * r / 3 - static_cast<double>(2 * (n - 1)) * cap;
    const BallUnion found = measure_ball_union(balls, {.complex = true}).value();
    EXPECT_NEAR(found.volume, 2 * rod, 1e-12 * rod);
    EXPECT_EQ(found.complex.edges.size(), 2 * (n - 1));
  }
}

}  // namespace
}  // namespace medial_vk
