// Complexes collapse to surfaces of the same homotopy type.
#include "medial_mesh/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Triangle = std::array<std::uint32_t, 3>;

double squared_length(const Ball& a, const Ball& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a.centre[i] - b.centre[i]) * (a.centre[i] - b.centre[i]);
  return sum;
}

DualComplex complex_of(const std::vector<Ball>& balls) {
  return measure_ball_union(balls, {.threads = 1, .complex = true}).value().complex;
}

DualComplex collapsed(const DualComplex& complex, const std::vector<Ball>& balls, double close) {
  const CollapseRule rule = {
      [&](std::uint32_t a, std::uint32_t b) { return squared_length(balls[a], balls[b]); },
      [&](std::uint32_t a, std::uint32_t b) { return squared_length(balls[a], balls[b]) <= close * close; }};
  return collapse_to_surface(complex, rule);
}

std::vector<int> triangles_by_edge(const DualComplex& complex) {
  std::vector<int> counts(complex.edges.size());
  for (const auto& [a, b, c] : complex.triangles) {
    for (const Edge& side : {Edge{a, b}, Edge{a, c}, Edge{b, c}}) {
      const auto found = std::lower_bound(complex.edges.begin(), complex.edges.end(), side);
      EXPECT_TRUE(found != complex.edges.end() && *found == side) << "a side is missing";
      ++counts[static_cast<std::size_t>(found - complex.edges.begin())];
    }
  }
  return counts;
}

// Solids with tunnels and cavities, at random.
TEST(Collapse, KeepsComponentsTunnelsAndCavities) {
  std::set<std::uint64_t> tunnels, cavities;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::vector<Ball> balls = test::random_balls(20 + 5 * seed, seed, 0.1, 0.2);
    const DualComplex complex = complex_of(balls);
    const BettiNumbers before = betti_numbers(complex).value();
    for (const double close : {0.0, 0.15, 10.0}) {
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(close));
      const DualComplex surface = collapsed(complex, balls, close);
      EXPECT_TRUE(surface.tetrahedra.empty());
      EXPECT_EQ(surface.vertices, complex.vertices);
      EXPECT_EQ(betti_numbers(surface).value(), before);
      const std::vector<int> counts = triangles_by_edge(surface);
      for (std::size_t e = 0; e < counts.size(); ++e) {
        if (counts[e] != 1) continue;
        EXPECT_LE(squared_length(balls[surface.edges[e][0]], balls[surface.edges[e][1]]), close * close);
      }
    }
    tunnels.insert(before.tunnels);
    cavities.insert(before.cavities);
  }
  EXPECT_GT(tunnels.size(), 5u) << "too few for a meaningful test";
  EXPECT_GT(cavities.size(), 3u) << "too few for a meaningful test";
}

// With ties of any kind: lattices, balls through a point, in a plane, of one centre.
TEST(Collapse, KeepsTheTopologyOfDegenerateBalls) {
  const std::vector<std::vector<Ball>> families = {test::lattice(4, 0.9),       test::flat_lattice(6, 0.8),
                                                   test::collinear(20, 1),      test::through_a_point(40, 2, true),
                                                   test::concentric(8, 3),      test::on_a_plane(40, 4),
                                                   test::of_all_sizes(60, 5),   test::cospherical(40, 0.2),
                                                   test::lattice(4, 0.5 + 1e-9)};
  for (std::size_t n = 0; n < families.size(); ++n) {
    SCOPED_TRACE(n);
    const DualComplex complex = complex_of(families[n]);
    const DualComplex surface = collapsed(complex, families[n], 10);
    EXPECT_EQ(betti_numbers(surface).value(), betti_numbers(complex).value());
    EXPECT_EQ(collapsed(complex, families[n], 10).triangles, surface.triangles);
  }
}

// A flat tetrahedron, as there are many along a sheet: the two triangles at its shorter diagonal remain.
TEST(Collapse, ASliverLeavesTheTrianglesAtTheShorterDiagonal) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}, {{0.5, 0.49, 0.01}, 1}, {{0.5, -0.49, 0.01}, 1}, {{1, 0, 0}, 1}};
  const DualComplex complex = complex_of(balls);
  ASSERT_EQ(complex.tetrahedra.size(), 1u);
  const DualComplex surface = collapsed(complex, balls, 0.99);
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(surface.edges.size(), 5u);
}

/// A square of 5 by 5 vertices, its 16 cells cut in two, and more triangles with all their sides.
DualComplex square(std::vector<Triangle> triangles) {
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      const std::uint32_t at = 5 * y + x;
      triangles.push_back({at, at + 1, at + 6});
      triangles.push_back({at, at + 5, at + 6});
    }
  }
  std::set<Edge> edges;
  std::set<std::uint32_t> vertices;
  for (const auto& [a, b, c] : triangles) {
    edges.insert({{a, b}, {a, c}, {b, c}});
    vertices.insert({a, b, c});
  }
  std::sort(triangles.begin(), triangles.end());
  return {{vertices.begin(), vertices.end()}, {edges.begin(), edges.end()}, std::move(triangles), {}};
}

TEST(Collapse, FinsGoAndSheetsStay) {
  const CollapseRule rule = {[](std::uint32_t a, std::uint32_t b) { return double{1} * (b - a); },
                             [](std::uint32_t, std::uint32_t) { return true; }};
  const DualComplex disc = square({});
  EXPECT_EQ(collapse_to_surface(disc, rule).triangles, disc.triangles);
  // All vertices of a fin are on its support: along a row, across triangles, with a fin on a fin.
  EXPECT_EQ(collapse_to_surface(square({{11, 12, 13}}), rule).triangles, disc.triangles);
  EXPECT_EQ(collapse_to_surface(square({{6, 11, 12}, {6, 7, 12}}), rule).edges, disc.edges);
  EXPECT_EQ(collapse_to_surface(square({{6, 7, 13}, {6, 13, 14}, {6, 13, 18}}), rule).triangles, disc.triangles);
  // A sheet has vertices of its own.
  const DualComplex with_sheet = square({{11, 12, 25}, {12, 13, 25}});
  EXPECT_EQ(collapse_to_surface(with_sheet, rule).triangles, with_sheet.triangles);
  // So many triangles on the same three edges close a cavity, which stays.
  const DualComplex with_bubble = square({{6, 7, 25}, {6, 12, 25}, {7, 12, 25}});
  EXPECT_EQ(betti_numbers(with_bubble).value(), (BettiNumbers{1, 0, 1}));
  EXPECT_EQ(collapse_to_surface(with_bubble, rule).triangles, with_bubble.triangles);
}

}  // namespace
}  // namespace medial_vk
