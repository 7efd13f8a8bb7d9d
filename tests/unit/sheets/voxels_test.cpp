// The basis of sheets: voxels that touch, areas within voxels, sets that threads join.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "base/voxel_order.h"
#include "sheets/concurrent_sets.h"
#include "sheets/voxel_graph.h"
#include "sheets/voxel_section.h"

namespace medial_vk {
namespace {

TEST(VoxelGraph, NeighboursAreThoseOfTheTwentySixVoxels) {
  std::mt19937 random(3);
  std::vector<MedialSphere> spheres;
  for (std::uint32_t z = 0; z < 6; ++z) {
    for (std::uint32_t y = 0; y < 6; ++y) {
      for (std::uint32_t x = 0; x < 6; ++x) {
        if (random() % 2 != 0) continue;
        MedialSphere& sphere = spheres.emplace_back();
        sphere.voxel = {x, y, z};
      }
    }
  }
  std::shuffle(spheres.begin(), spheres.end(), random);
  const VoxelGraph graph(spheres);
  ASSERT_EQ(graph.size(), spheres.size());
  for (std::uint32_t a = 0; a < graph.size(); ++a) {
    EXPECT_EQ(&graph.sphere(a), &spheres[graph.index(a)]);
    EXPECT_TRUE(a == 0 || is_earlier_voxel(graph.sphere(a - 1).voxel, graph.sphere(a).voxel));
    std::vector<std::uint32_t> expected;
    for (std::uint32_t b = 0; b < graph.size(); ++b) {
      if (a != b && graph.touch(a, b)) expected.push_back(b);
    }
    const auto found = graph.neighbours(a);
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
  }
}

TEST(VoxelSection, KnownAreas) {
  constexpr double kTolerance = 1e-12;
  EXPECT_NEAR(section_area({0.5, 0.5, 0.3}, {0, 0, 2}), 1, kTolerance);
  EXPECT_NEAR(section_area({0.5, 0.5, 0.5}, {1, 1, 0}), std::sqrt(2), kTolerance);
  EXPECT_NEAR(section_area({0.5, 0.5, 0.5}, {1, 1, 1}), 0.75 * std::sqrt(3), kTolerance);  // the regular hexagon
  EXPECT_NEAR(section_area({1 / 3.0, 1 / 3.0, 1 / 3.0}, {1, 1, 1}), std::sqrt(3) / 2, kTolerance);
  EXPECT_EQ(section_area({0.5, 0.5, 1.5}, {0, 0, 1}), 0);
  EXPECT_EQ(section_area({0.5, 0.5, 0.5}, {0, 0, 0}), 0);
}

TEST(ConcurrentSets, TheRootIsTheLeastMemberWhateverTheThreads) {
  constexpr std::uint32_t kSize = 40000;
  ConcurrentSets sets(kSize);
  const auto work = [&](std::uint32_t seed) {
    std::mt19937 random(seed);
    // Chains of every seventh, in a random order: seven sets.
    std::vector<std::uint32_t> order(kSize - 7);
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    for (const std::uint32_t i : order) sets.join(i, i + 7);
  };
  std::vector<std::thread> threads;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) threads.emplace_back(work, seed);
  for (std::thread& thread : threads) thread.join();
  for (std::uint32_t i = 0; i < kSize; ++i) ASSERT_EQ(sets.root(i), i % 7);
}

}  // namespace
}  // namespace medial_vk
