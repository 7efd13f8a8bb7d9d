// Homology of complexes built by hand, and of parts of dual complexes against plain ranks of boundary matrices.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "ball_unions/unions/simplex_lists.h"
#include "medial_vk/ball_union.h"
#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

/// The complex of these simplices and all their faces.
DualComplex complete(DualComplex complex) {
  std::vector<EnvelopeVertex> none;
  make_complete(complex, none);
  return complex;
}

DualComplex of_triangles(std::vector<std::array<std::uint32_t, 3>> triangles) {
  for (auto& t : triangles) std::sort(t.begin(), t.end());
  return complete({.vertices = {}, .edges = {}, .triangles = std::move(triangles), .tetrahedra = {}});
}

/// The boundary of the tetrahedron of four vertices.
void add_sphere(std::vector<std::array<std::uint32_t, 3>>& triangles, const std::array<std::uint32_t, 4>& v) {
  for (std::size_t k = 0; k < 4; ++k) triangles.push_back(face(v, k));
}

TEST(MakeComplete, AddsFacesSortsAndDropsDuplicates) {
  DualComplex complex = {.vertices = {9, 2, 9},
                         .edges = {{2, 9}, {2, 9}},
                         .triangles = {{3, 4, 5}, {1, 2, 3}},
                         .tetrahedra = {{3, 4, 5, 6}, {3, 4, 5, 6}}};
  std::vector<EnvelopeVertex> vertices = {{{1, 0, 0}, {1, 2, 3}}, {{0, 0, 0}, {1, 2, 3}}, {{5, 0, 0}, {0, 2, 3}}};
  make_complete(complex, vertices);
  EXPECT_EQ(complex.vertices, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 9}));
  EXPECT_EQ(complex.edges.size(), 6u + 3u + 1u);
  EXPECT_TRUE(std::is_sorted(complex.edges.begin(), complex.edges.end()));
  EXPECT_EQ(complex.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{1, 2, 3}, {3, 4, 5}, {3, 4, 6}, {3, 5, 6}, {4, 5, 6}}));
  EXPECT_EQ(complex.tetrahedra.size(), 1u);
  EXPECT_EQ(vertices[0].balls[0], 0u);
  EXPECT_EQ(vertices[1].at[0], 0);
}

TEST(BettiNumbersOf, NothingPointsAndLines) {
  EXPECT_EQ(betti_numbers({}).value(), (BettiNumbers{0, 0, 0}));
  EXPECT_EQ(betti_numbers(complete({.vertices = {3, 5, 8}, .edges = {}, .triangles = {}, .tetrahedra = {}})).value(),
            (BettiNumbers{3, 0, 0}));
  const DualComplex circle = {.vertices = {7}, .edges = {{0, 1}, {1, 2}, {0, 2}}, .triangles = {}, .tetrahedra = {}};
  EXPECT_EQ(betti_numbers(complete(circle)).value(), (BettiNumbers{2, 1, 0}));
}

TEST(ComponentOfVertices, IsNumberedInTheOrderOfFirstVertices) {
  const DualComplex complex =
      complete({.vertices = {2, 8}, .edges = {{4, 9}, {3, 7}, {7, 9}, {1, 5}}, .triangles = {}, .tetrahedra = {}});
  ASSERT_EQ(complex.vertices, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 7, 8, 9}));
  EXPECT_EQ(component_of_vertices(complex).value(), (std::vector<std::uint32_t>{0, 1, 2, 2, 0, 2, 3, 2}));
  EXPECT_TRUE(component_of_vertices({}).value().empty());
}

TEST(BettiNumbersOf, Spheres) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  add_sphere(triangles, {0, 1, 2, 3});
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{1, 0, 1}));
  add_sphere(triangles, {3, 4, 5, 6});  // they share a vertex
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{1, 0, 2}));
  add_sphere(triangles, {4, 5, 6, 7});  // and these a triangle, which creates two cavities
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{1, 0, 3}));
  add_sphere(triangles, {10, 11, 12, 13});
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{2, 0, 4}));
}

TEST(BettiNumbersOf, FullAndHalfFullSpheres) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  add_sphere(triangles, {3, 4, 5, 6});
  DualComplex complex = {.vertices = {}, .edges = {{0, 6}}, .triangles = triangles, .tetrahedra = {{0, 1, 2, 3}}};
  EXPECT_EQ(betti_numbers(complete(complex)).value(), (BettiNumbers{1, 1, 1}));
  complex.tetrahedra.push_back({3, 4, 5, 6});
  EXPECT_EQ(betti_numbers(complete(complex)).value(), (BettiNumbers{1, 1, 0}));
}

/// Seven vertices, each pair of them joined (Csaszar's polyhedron).
TEST(BettiNumbersOf, ATorus) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 7; ++i) {
    triangles.push_back({i, (i + 1) % 7, (i + 3) % 7});
    triangles.push_back({i, (i + 2) % 7, (i + 3) % 7});
  }
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{1, 2, 1}));
  triangles.pop_back();  // a hole: two circles are left
  EXPECT_EQ(betti_numbers(of_triangles(triangles)).value(), (BettiNumbers{1, 2, 0}));
}

/// The rank over Z/2, column by column.
template <std::size_t N>
std::size_t rank_of_boundary(const std::vector<std::array<std::uint32_t, N>>& simplices,
                             const std::vector<std::array<std::uint32_t, N - 1>>& faces) {
  std::vector<std::vector<bool>> pivots(faces.size());
  std::size_t rank = 0;
  for (const auto& simplex : simplices) {
    std::vector<bool> column(faces.size());
    for (std::size_t k = 0; k < N; ++k) column[index_in(faces, face(simplex, k))] = true;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!column[f]) continue;
      if (pivots[f].empty()) {
        pivots[f] = column;
        ++rank;
        break;
      }
      for (std::size_t g = f; g < faces.size(); ++g) column[g] = column[g] != pivots[f][g];
    }
  }
  return rank;
}

BettiNumbers by_ranks(const DualComplex& complex) {
  std::vector<std::array<std::uint32_t, 1>> vertices;
  for (const std::uint32_t v : complex.vertices) vertices.push_back({v});
  const std::size_t of_edges = rank_of_boundary(complex.edges, vertices);
  const std::size_t of_triangles = rank_of_boundary(complex.triangles, complex.edges);
  const std::size_t of_tetrahedra = rank_of_boundary(complex.tetrahedra, complex.triangles);
  return {vertices.size() - of_edges, complex.edges.size() - of_edges - of_triangles,
          complex.triangles.size() - of_triangles - of_tetrahedra};
}

/// Some of the simplices of each dimension, with their faces.
DualComplex part_of(const DualComplex& whole, std::mt19937& random) {
  const auto some = [&](const auto& list, unsigned long of_ten) {
    auto part = list;
    part.erase(std::remove_if(part.begin(), part.end(), [&](const auto&) { return random() % 10 >= of_ten; }),
               part.end());
    return part;
  };
  return complete({some(whole.vertices, 9), some(whole.edges, random() % 11), some(whole.triangles, random() % 11),
                   some(whole.tetrahedra, random() % 11)});
}

TEST(BettiNumbersOf, PartsOfDualComplexes) {
  std::mt19937 random(1);
  std::uint64_t cavities = 0, tunnels = 0;
  for (unsigned n = 0; n < 60; ++n) {
    const auto result = measure_ball_union(test::random_balls(40, n, 0.2, 0.4), {.threads = 1, .complex = true});
    ASSERT_TRUE(result.ok());
    const DualComplex part = part_of(result.value().complex, random);
    const BettiNumbers expected = by_ranks(part);
    EXPECT_EQ(betti_numbers(part).value(), expected) << n;
    cavities += expected.cavities;
    tunnels += expected.tunnels;
  }
  EXPECT_GT(cavities, 100u);
  EXPECT_GT(tunnels, 100u);
}

}  // namespace
}  // namespace medial_vk
