// Everything that is said about distances, against the reference: a part of what tests/soak/soak_distances.cpp runs.
#include <gtest/gtest.h>

#include <vector>

#include "cpu_reference/distance_mesh.h"
#include "support/distances/distance_cases.h"
#include "support/random_poses.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

TEST(DistanceCases, NoIntervalExcludesTheReferencesDistance) {
  const std::vector<DistanceSolid> solids =
      generated_distance_solids([](const IndexedMesh& mesh) { return grid_balls(mesh, 4); });
  std::size_t hits = 0, free = 0;
#ifdef MEDIAL_VK_SANITIZED
  constexpr std::uint64_t kCount = 200;  // twenty times as slow, and each kind takes the same code
#else
  constexpr std::uint64_t kCount = 1000;
#endif
  constexpr std::uint64_t kStride = 10'000'019;  // seeds over all kinds
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const std::uint64_t seed = i * kStride;
    const CaseOutcome outcome = check_distance_case(make_distance_case(solids, seed), seed);
    for (const std::string& fault : outcome.faults) ADD_FAILURE() << fault;
    hits += outcome.collision == Collision::kHit ? 1u : 0u;
    free += outcome.collision == Collision::kFree ? 1u : 0u;
  }
  EXPECT_GT(hits, kCount / 5);
  EXPECT_GT(free, kCount / 5);
}

// The reference with its balls, against all pairs of triangles.
TEST(DistanceCases, TheReferenceLeavesOutNoPair) {
  Random random(1);
  const reference::Mesh a = to_reference(make_torus(0.5, 0.2, 12, 18)), b = to_reference(make_cup(0.5, 0.1, 0.8, 16));
  const reference::DistanceMesh many_a(a), many_b(b);
  for (const double far : {0.3, 1.0, 3.0, 1e3, 1e6}) {
    for (int i = 0; i < 20; ++i) {
      const Pose pose = any_pose(random, point_in_cube(random, far));
      reference::Motion motion;
      for (int row = 0; row < 3; ++row) {
        const auto r = static_cast<std::size_t>(row);
        motion.rotation.row(row) << pose.rotation[r][0], pose.rotation[r][1], pose.rotation[r][2];
        motion.shift[row] = pose.shift[r];
      }
      // Pairs that are equally close may differ by the roundings of their coordinates.
      EXPECT_NEAR(reference::nearest_of_meshes(many_a, many_b, motion).distance,
                  reference::nearest_of_meshes(a, b, motion).distance, 64 * 0x1p-53 * (2 + far));
    }
  }
}

}  // namespace
}  // namespace medial_vk
