// Fat sets of spheres: Lemma 8.1 against the exact topology of unions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/fatness.h"

namespace medial_vk {
namespace {

const VoxelGrid kGrid = {{-1, 2, 0.5}, 0.25, {8, 8, 8}};

MedialSphere sphere_in(const std::array<std::uint32_t, 3>& voxel, const Point& share, double radius, float angle) {
  MedialSphere sphere{};
  for (std::size_t k = 0; k < 3; ++k) {
    sphere.centre[k] = kGrid.origin[k] + (voxel[k] + share[k]) * kGrid.voxel_size;
  }
  sphere.voxel = voxel;
  sphere.radius = radius;
  sphere.object_angle = angle;
  return sphere;
}

std::uint64_t components_of_union(const std::vector<MedialSphere>& spheres) {
  std::vector<Ball> balls;
  for (const MedialSphere& sphere : spheres) balls.push_back({sphere.centre, sphere.radius});
  BallUnionOptions options;
  options.complex = true;
  return betti_numbers(measure_ball_union(balls, options).value().complex).value().components;
}

TEST(Fatness, SetsThatAreProvedToBeConnectedAre) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> share(0.01, 0.99), size(1, 1.3);
  std::uniform_int_distribution<std::uint32_t> coordinate(0, 3);
  int proved = 0, not_proved = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<MedialSphere> spheres;
    std::set<std::array<std::uint32_t, 3>> voxels;
    while (voxels.size() < 6) voxels.insert({coordinate(random), coordinate(random), coordinate(random)});
    const double radius = size(random) * std::sqrt(3.0) * kGrid.voxel_size * (i % 3 == 0 ? 0.4 : 1);
    for (const auto& voxel : voxels) {
      spheres.push_back(sphere_in(voxel, {share(random), share(random), share(random)}, radius, 1));
    }
    const Fatness fatness = measure_fatness(spheres, kGrid, std::vector<double>{0.6}).value().front();
    (fatness.proves_connected ? proved : not_proved)++;
    if (fatness.proves_connected) {
      EXPECT_EQ(components_of_union(spheres), 1u);
    }
    EXPECT_EQ(fatness.proves_connected, fatness.components == 1 && i % 3 != 0);
  }
  EXPECT_GT(proved, 10);
  EXPECT_GT(not_proved, 10);
}

TEST(Fatness, DependsOnTheObjectAngle) {
  const std::vector<MedialSphere> spheres = {sphere_in({0, 0, 0}, {0.5, 0.5, 0.5}, 0.1, 0.7f),
                                             sphere_in({1, 1, 1}, {0.5, 0.5, 0.5}, 0.9, 1.0f),
                                             sphere_in({3, 1, 1}, {0.5, 0.5, 0.5}, 0.8, 1.2f)};
  const std::vector<Fatness> all = measure_fatness(spheres, kGrid, std::vector<double>{0.6, 0.9, 1.1, 1.5}).value();
  EXPECT_EQ(all[0].spheres, 3u);
  EXPECT_EQ(all[0].least_radius, 0.1);
  EXPECT_EQ(all[0].components, 2u);
  EXPECT_EQ(all[1].least_radius, 0.8);
  EXPECT_DOUBLE_EQ(all[1].largest_voxel, 0.8 / std::sqrt(3.0));
  EXPECT_FALSE(all[1].proves_connected);  // two voxels with one between them
  EXPECT_TRUE(all[2].proves_connected);
  EXPECT_EQ(all[3].spheres, 0u);
  EXPECT_EQ(all[3].least_radius, 0);
  EXPECT_FALSE(all[3].proves_connected);
}

TEST(Fatness, NoPointOfAVoxelIsCloserToTheBoundary) {
  // From the middle of a voxel to a corner.
  const double half_diagonal = 0.5 * std::sqrt(3.0) * kGrid.voxel_size;
  const std::vector<MedialSphere> one = {sphere_in({2, 2, 2}, {0.5, 0.5, 0.5}, 1, 1)};
  EXPECT_LE(least_medial_radius(one, kGrid), 1 - half_diagonal);
  EXPECT_GE(least_medial_radius(one, kGrid), 1 - half_diagonal - 1e-12);
  EXPECT_EQ(least_medial_radius(std::vector<MedialSphere>{sphere_in({2, 2, 2}, {0, 0, 0}, 0.1, 1)}, kGrid), 0);
  EXPECT_EQ(least_medial_radius({}, kGrid), 0);
}

TEST(Fatness, RefusesAnglesThatAreNoNumbers) {
  const auto result = measure_fatness({}, kGrid, std::vector<double>{std::nan("")});
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
  EXPECT_THAT(result.error().message, testing::HasSubstr("`object_angles`"));
}

}  // namespace
}  // namespace medial_vk
