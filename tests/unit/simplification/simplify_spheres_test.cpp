// The simplification at the end of Section 2.4.2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "simplification/simplify_spheres.h"

namespace medial_vk {
namespace {

constexpr double kVoxel = 1.0;

MedialSphere sphere_at(double x, double y, double z) {
  MedialSphere sphere;
  sphere.centre = {x, y, z};
  sphere.radius = 1;
  for (std::size_t i = 0; i < 3; ++i) sphere.voxel[i] = static_cast<std::uint32_t>(sphere.centre[i] / kVoxel);
  return sphere;
}

/// At most one point per voxel, in voxel order, with every point within 0.1 of a corner or wall often enough.
std::vector<MedialSphere> random_spheres(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  std::vector<MedialSphere> out;
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        // Pushed towards the walls: t -> 0 or 1.
        const auto near_wall = [&] {
          const double t = anywhere(random);
          return std::min(0.5 + 0.5 * std::copysign(std::pow(std::abs(2 * t - 1), 0.2), 2 * t - 1), 0.999999);
        };
        out.push_back(sphere_at(x + near_wall(), y + near_wall(), z + near_wall()));
      }
    }
  }
  return out;
}

double distance(const MedialSphere& a, const MedialSphere& b) {
  return std::hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1], a.centre[2] - b.centre[2]);
}

TEST(OutputSimplify, TheFirstInVoxelOrderStays) {
  std::vector<MedialSphere> spheres = {sphere_at(0.999, 0.5, 0.5), sphere_at(1.001, 0.5, 0.5),
                                       sphere_at(2.5, 0.5, 0.5)};
  EXPECT_EQ(simplify_spheres(0.01, spheres), 1u);
  ASSERT_EQ(spheres.size(), 2u);
  EXPECT_EQ(spheres[0].centre[0], 0.999);
  EXPECT_EQ(spheres[1].centre[0], 2.5);
}

TEST(OutputSimplify, ACrowdAroundACornerLeavesOne) {
  std::vector<MedialSphere> spheres;
  for (int i = 0; i < 8; ++i) {
    spheres.push_back(sphere_at(i % 2 ? 1.001 : 0.999, i / 2 % 2 ? 1.001 : 0.999, i / 4 ? 1.001 : 0.999));
  }
  EXPECT_EQ(simplify_spheres(0.01, spheres), 7u);
  EXPECT_EQ(spheres.size(), 1u);
}

TEST(OutputSimplify, FarPointsStay) {
  std::vector<MedialSphere> spheres = {sphere_at(0.98, 0.5, 0.5), sphere_at(1.02, 0.5, 0.5)};
  EXPECT_EQ(simplify_spheres(0.01, spheres), 0u);
  EXPECT_EQ(spheres.size(), 2u);
  std::vector<MedialSphere> none;
  EXPECT_EQ(simplify_spheres(0.01, none), 0u);
}

TEST(OutputSimplify, KeptPointsAreApartAndRemovedOnesAreCovered) {
  constexpr double kEpsilon = 0.1;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const std::vector<MedialSphere> before = random_spheres(seed);
    std::vector<MedialSphere> after = before;
    const std::uint64_t removed = simplify_spheres(kEpsilon, after);
    EXPECT_EQ(removed, before.size() - after.size());
    EXPECT_GT(removed, 0u);

    for (std::size_t i = 0; i < after.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) ASSERT_GT(distance(after[i], after[j]), kEpsilon);
    }
    std::map<std::size_t, int> covers;  // Section 2.4.2: at most 7 removed for each one kept.
    for (const MedialSphere& sphere : before) {
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < after.size(); ++i) {
        if (distance(after[i], sphere) < distance(after[nearest], sphere)) nearest = i;
      }
      ASSERT_LE(distance(after[nearest], sphere), kEpsilon);
      ++covers[nearest];
    }
    for (const auto& [index, count] : covers) EXPECT_LE(count, 8);

    std::vector<MedialSphere> again = after;
    EXPECT_EQ(simplify_spheres(kEpsilon, again), 0u);
  }
}

}  // namespace
}  // namespace medial_vk
