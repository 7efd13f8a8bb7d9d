// Signed crossings of rays, with and without the triangles that close a mesh, against sums of solid angles.
#include "solid/closing_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bvh/signed_crossings.h"
#include "mesh/winding/winding_number.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr Point kDirection = {0.13, -0.91, 0.37};

Bvh tree_of(const Mesh& mesh) { return Bvh::build({mesh.vertices, mesh.triangles, {}, false}).value(); }

class PointsInBox {
 public:
  Point next() { return {range_(random_), range_(random_), range_(random_)}; }

 private:
  std::mt19937_64 random_{3};
  std::uniform_real_distribution<double> range_{-1.2, 1.2};
};

/// `parts`: the closing triangles.
void expect_closed(const Mesh& mesh, std::size_t parts) {
  const auto closing = ClosingSurface::build(mesh, MeshTopology(mesh)).value();
  ASSERT_EQ(closing ? closing->size() : 0, parts);
  const Bvh bvh = tree_of(mesh);
  PointsInBox points;
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Point p = points.next();
    auto whole = signed_crossings(bvh, p, kDirection);
    ASSERT_TRUE(whole);
    if (closing) {
      const auto added = signed_crossings(closing->bvh(), p, kDirection);
      ASSERT_TRUE(added);
      *whole += *added;
    }
    const double number = static_cast<double>(*whole), exact = exact_winding_number(mesh, p);
    EXPECT_NEAR(number - (closing ? closing->number(p) : 0), exact, 1e-11);
    EXPECT_NEAR(number - (closing ? closing->rough_number(p) : 0), exact, 0.03);
    inside += exact >= 0.5;
  }
  EXPECT_GT(inside, 0);
}

TEST(ClosingSurface, MakesWindingNumbersWhole) {
  Mesh torus = test::make_torus(0.7, 0.3, 20, 40);
  expect_closed(torus, 0);
  torus.triangles.resize(torus.triangles.size() * 3 / 4);  // two rims of 20 edges
  expect_closed(torus, 40);
  // Two sheets in one place: all edges are open twice.
  Mesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}};
  sheet.triangles = {{0, 1, 2}, {0, 1, 2}};
  expect_closed(sheet, 6);
}

// Rims of a thousand edges with waves, one above the other: long triangles in layers between each rim and its apex.
TEST(ClosingSurface, OfWavyRimsHasTheErrorOfOtherMeshes) {
  constexpr std::uint32_t kEdges = 1000, kRims = 8;
  Mesh bands;
  for (std::uint32_t rim = 0; rim < kRims; ++rim) {
    const auto first = static_cast<std::uint32_t>(bands.vertices.size());
    for (std::uint32_t i = 0; i < kEdges; ++i) {
      const double angle = 2 * std::numbers::pi * i / kEdges, radius = 0.8 + 0.1 * std::sin(31 * angle);
      for (const double up : {0.0, 0.02})
        bands.vertices.push_back(
            {radius * std::cos(angle), radius * std::sin(angle), 0.1 * rim - 0.4 + up + 0.03 * std::sin(17 * angle)});
    }
    for (std::uint32_t i = 0; i < kEdges; ++i) {
      const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % kEdges);
      bands.triangles.push_back({a, b, b + 1});
      bands.triangles.push_back({a, b + 1, a + 1});
    }
  }
  const auto closing = ClosingSurface::build(bands, MeshTopology(bands)).value();
  ASSERT_EQ(closing->size(), 2 * kEdges * kRims);
  PointsInBox points;
  for (int i = 0; i < 300; ++i) {
    const Point p = points.next();
    EXPECT_NEAR(closing->rough_number(p), closing->number(p), 0.03);
  }
}

// Two copies of a box, one of them turned inside out, and a third: the sum of the parts.
TEST(SignedCrossings, CountTrianglesThatCoincide) {
  Mesh box = test::make_box({1, 1, 1});
  const std::size_t triangles = box.triangles.size();
  const Point middle = {0.48, 0.47, 0.51};
  const auto at_middle = [&] { return signed_crossings(tree_of(box), middle, kDirection); };
  EXPECT_EQ(at_middle(), 1);
  for (std::size_t t = 0; t < triangles; ++t) box.triangles.push_back(box.triangles[t]);
  EXPECT_EQ(at_middle(), 2);
  for (std::size_t t = 0; t < triangles; ++t)
    box.triangles.push_back({box.triangles[t][0], box.triangles[t][2], box.triangles[t][1]});
  EXPECT_EQ(at_middle(), 1);
}

// Through a corner, along a diagonal of a face, and from a point on a face.
TEST(SignedCrossings, AreUnknownWhereRoundingDecides) {
  const Bvh box = tree_of(test::make_box({1, 1, 1}));
  const Point middle = {0.5, 0.5, 0.5};
  EXPECT_FALSE(signed_crossings(box, middle, {1, 1, 1}));
  EXPECT_FALSE(signed_crossings(box, middle, {1, 0.5, 0.5}));
  EXPECT_FALSE(signed_crossings(box, {0.3, 0.4, 1}, {0.1, 0.2, 1}));
  EXPECT_EQ(signed_crossings(box, middle, {1, 0.5, 0.3}), 1);
}

}  // namespace
}  // namespace medial_vk
