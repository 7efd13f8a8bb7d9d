// The division of a surface among balls.
#include "cover_following/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Exactly: all numbers are multiples of 2^-10, and hulls run in one direction.
bool holds(const Patches& patches, const Patch& patch, double v, double w) {
  bool is_left = true, is_right = true;
  for (std::uint32_t k = 0; k < patch.count; ++k) {
    const Weights &a = patches.corners[patch.first + k], &b = patches.corners[patch.first + (k + 1) % patch.count];
    const double side = (b[1] - a[1]) * (w - a[2]) - (b[2] - a[2]) * (v - a[1]);
    is_left = is_left && side >= 0;
    is_right = is_right && side <= 0;
  }
  return is_left || is_right;
}

TEST(Patches, LeaveOutNoPoint) {
  const CoverExample example = covered_torus();
  const auto view = example.mesh.view();
  const Patches patches = divide_boundary(view.vertices, view.triangles, example.balls, 1);
  std::vector<std::vector<const Patch*>> of_triangle(view.triangles.size());
  for (const Patch& patch : patches.patches) of_triangle[patch.triangle].push_back(&patch);
  constexpr int kSide = 64;
  std::size_t divided = 0;
  for (const auto& parts : of_triangle) {
    divided += parts.size() > 1 ? 1 : 0;
    for (int i = 0; i <= kSide; ++i) {
      for (int j = 0; i + j <= kSide; ++j) {
        const double v = static_cast<double>(i) / kSide, w = static_cast<double>(j) / kSide;
        EXPECT_TRUE(
            std::any_of(parts.begin(), parts.end(), [&](const Patch* part) { return holds(patches, *part, v, w); }));
      }
    }
  }
  EXPECT_GT(divided, 0u);
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
