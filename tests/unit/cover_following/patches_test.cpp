// The division of a surface among balls.
#include "cover_following/patches.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/cover_following/cover_example.h"

namespace medial_vk {
namespace {

/// As a share of the triangle, exactly: weights are multiples of 2^-10.
double hull_area(const Patches& patches, const Patch& patch) {
  double area = 0;
  for (std::uint32_t k = 1; k + 1 < patch.count; ++k) {
    const Weights &a = patches.corners[patch.first], &b = patches.corners[patch.first + k],
                  &c = patches.corners[patch.first + k + 1];
    area += std::fabs((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
  }
  return area;
}

TEST(Patches, FillEveryTriangle) {
  for (const CoverExample& example : {covered_torus(), covered_l_shape()}) {
    const auto [vertices, triangles, flags, closed] = example.mesh.view();
    const Patches patches = divide_boundary(vertices, triangles, example.balls, 2);
    std::vector<double> shares(triangles.size()), areas(triangles.size());
    for (const Patch& patch : patches.patches) {
      const double share = hull_area(patches, patch);
      EXPECT_GT(share, 0);
      shares[patch.triangle] += share;
      areas[patch.triangle] += patch.area;
      for (std::uint32_t k = patch.first; k < patch.first + patch.count; ++k) {
        const Weights& weights = patches.corners[k];
        EXPECT_EQ(weights[0] + weights[1] + weights[2], 1);
        EXPECT_GE(std::min({weights[0], weights[1], weights[2]}), 0);
      }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& corner = triangles[t];
      const double area =
          0.5 * length(cross(vertices[corner[1]] - vertices[corner[0]], vertices[corner[2]] - vertices[corner[0]]));
      EXPECT_GE(shares[t], 1);  // hulls may overlap
      EXPECT_NEAR(areas[t], area, 1e-14);
    }
  }
}

TEST(Patches, LieInTheirBallsWhereOneHoldsThem) {
  // Cells overlap, so each small enough part lies in a ball: none must grow.
  const CoverExample example = covered_l_shape();
  const auto view = example.mesh.view();
  const Patches patches = divide_boundary(view.vertices, view.triangles, example.balls, 1);
  for (std::size_t i = 0; i < example.balls.size(); ++i) {
    for (const Patch& patch : patches.of(i)) {
      const Triangle& t = view.triangles[patch.triangle];
      for (std::uint32_t k = patch.first; k < patch.first + patch.count; ++k) {
        const Point p = point_of(patches.corners[k], {view.vertices[t[0]], view.vertices[t[1]], view.vertices[t[2]]});
        EXPECT_LE(length(p - example.balls[i].centre), 1.0010001 * example.balls[i].radius);
      }
    }
  }
}

TEST(Patches, BallsWithoutARadiusGetNone) {
  const CoverExample example = covered_l_shape();
  std::vector<Ball> balls = {{{0, 0, 0}, 0}, {{1, 1, 0.4}, 3}, {{0, 0, 0}, 0}};
  const Patches patches = divide_boundary(example.mesh.view().vertices, example.mesh.view().triangles, balls, 1);
  EXPECT_TRUE(patches.of(0).empty());
  EXPECT_EQ(patches.of(1).size(), example.mesh.view().triangles.size());
  EXPECT_TRUE(patches.of(2).empty());
}

}  // namespace
}  // namespace medial_vk
