// Patches of the boundary at some tips, and their mean at others.
#include "curvature/patch_blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr Point kTip = {0, 0, 0}, kUp = {0, 0, 1};
// Sums of a few products, of magnitude 1 and less, are rounded some ten times.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

/// Over the tip, the height -(a x^2 + b y^2) / 2: principal curvatures a along x and b along y.
TipPatch patch(double a, double b, double spread) {
  TipPatch out;
  out.is_known = true;
  out.origin = kTip;
  out.frame = {{1, 0, 0}, {0, 1, 0}, kUp};
  out.radius = 1;
  out.coefficients[static_cast<Eigen::Index>(term_of(2, 0))] = -a / 2;
  out.coefficients[static_cast<Eigen::Index>(term_of(0, 2))] = -b / 2;
  out.spread = spread;
  return out;
}

/// Patches whose middles are on the x axis.
struct Patches {
  std::vector<TipPatch> patches;
  TipCloud middles;

  void add(const TipPatch& one, double x, const Point& normal = kUp) {
    patches.push_back(one);
    middles.tips.push_back({x, 0, 0});
    middles.normals.push_back(normal);
  }
  TipFit blended(double reach) const {
    return blend_patches(patches, middles, PointGrid(middles.tips, reach), kTip, kUp, reach);
  }
};

TEST(PatchBlend, WeighsByDistance) {
  // At a half and three quarters of the reach, (1 - 1/4)^2 = 144/256 and (1 - 9/16)^2 = 49/256: shares of 144 and 49 in
  // 193. At the reach itself the weight is 0, so that results don't jump where a patch comes within it.
  Patches some;
  some.add(patch(1, 4, 0.1), 0.25);
  some.add(patch(3, 2, 0.3), -0.375);
  some.add(patch(100, 100, 100), 0.5);
  const TipFit fit = some.blended(0.5);
  ASSERT_TRUE(fit.is_known);
  EXPECT_NEAR(fit.form(0, 0), (144.0 * 1 + 49.0 * 3) / 193, 4 * kRounding);
  EXPECT_NEAR(fit.form(1, 1), (144.0 * 4 + 49.0 * 2) / 193, 4 * kRounding);
  EXPECT_NEAR(fit.spread, (144.0 * 0.1 + 49.0 * 0.3) / 193, kRounding);
  EXPECT_NEAR(length(fit.normal - kUp), 0, kRounding);
}

TEST(PatchBlend, TakesPatchesOfOneSideWithinReach) {
  Patches some;
  some.add(patch(1, 2, 0), 0.1);
  some.add(patch(50, 50, 0), 0.1, {0, 0, -1});  // across a thin wall
  some.add(patch(70, 70, 0), 0.6);
  const TipFit fit = some.blended(0.5);
  ASSERT_TRUE(fit.is_known);
  EXPECT_NEAR(fit.form(0, 0), 1, kRounding);
  EXPECT_NEAR(fit.form(1, 1), 2, kRounding);
  EXPECT_FALSE(some.blended(0.05).is_known);  // none is within reach
}

TEST(PatchBlend, IsNotKnownBesideAnUnknownPatch) {
  Patches some;
  some.add(patch(1, 2, 0), 0.1);
  some.add({}, -0.4);
  EXPECT_FALSE(some.blended(0.5).is_known);
  EXPECT_TRUE(some.blended(0.3).is_known);
}

TEST(PatchBlend, IsCutAsTheNearestPatch) {
  TipPatch cut = patch(1, 2, 0);
  cut.is_cut = true;
  Patches far_one, near_one;
  far_one.add(patch(1, 2, 0), 0.1);
  far_one.add(cut, -0.2);
  near_one.add(cut, -0.1);
  near_one.add(patch(1, 2, 0), 0.2);
  EXPECT_FALSE(far_one.blended(0.5).is_cut);
  EXPECT_TRUE(near_one.blended(0.5).is_cut);
}

TEST(PatchBlend, HasAnchorsApartAndNearAllTips) {
  constexpr std::size_t kTips = 101;
  constexpr double kStep = 0.01, kApart = kAnchorShare;
  TipCloud cloud;
  for (std::size_t i = 0; i < kTips; ++i) {
    // Both sides of a thin wall: every other tip.
    cloud.tips.push_back({kStep * static_cast<double>(i), 0, 0});
    cloud.normals.push_back({0, 0, i % 2 == 0 ? 1.0 : -1.0});
  }
  const std::vector<std::uint32_t> anchors = anchors_of(cloud, PointGrid(cloud.tips, kApart), kApart);
  ASSERT_LT(anchors.size(), kTips / 4);
  for (std::uint32_t i = 0; i < kTips; ++i) {
    std::size_t near = 0;
    for (const std::uint32_t anchor : anchors) {
      if (i % 2 != anchor % 2) continue;
      const double distance = length(cloud.tips[i] - cloud.tips[anchor]);
      if (distance <= kApart) ++near;
      if (distance > 0 && std::ranges::find(anchors, i) != anchors.end()) {
        EXPECT_GT(distance, kApart);
      }
    }
    EXPECT_GE(near, 1u) << i;
  }
}

}  // namespace
}  // namespace medial_vk
