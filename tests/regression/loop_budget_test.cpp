// lavapipe ends an invocation's loops silently after 65,535 iterations. A finely faceted sphere is the worst case: near
// its centre every triangle is a contact, and each must be examined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "device_mesh/clusters.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solids.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kLoopBudget = 65535;

/// Extracts a sphere of radius 1 and more than three budgets of triangles, at least; checks the points at its centre:
/// one in the middle voxel if the resolution is odd, and if it is even one in each of the eight voxels that share the
/// centre as a corner.
void expect_centre_found(std::uint32_t resolution, std::uint32_t triangles, CertifiedExtraction& result) {
  const PreparedMesh mesh = test::prepare(test::make_sphere(1, triangles));
  ASSERT_GT(mesh.mesh.triangles.size(), 3 * kLoopBudget);
  ExtractionOptions options;
  options.resolution = resolution;
  options.object_angle = 0.6;
  Context context = test::make_context();
  result = test::extract_on_device(context, mesh, options);
  SCOPED_TRACE(test::describe(result));
  ASSERT_EQ(result.extraction.spheres.size(), resolution % 2 == 1 ? 1u : 8u);
  EXPECT_TRUE(test::passes_certificate(mesh, result.extraction, options));
  EXPECT_EQ(result.extraction.measurements.counters.undecided, 0u);
  EXPECT_EQ(result.certificate.rejected, 0u);
  // Frequency 100 or more: edges up to 0.02, facets up to edge^2 / 5 = 8e-5 below the sphere, their normals turned by
  // 0.02 at most. A point that passes as salient lies within (2 epsilon + 2 * 8e-5) / (cos 0.02 - cos 0.6) of the
  // centre: see salient_reach() in tests/analytic/smooth_solids_test.cpp.
  const double epsilon = options.epsilon * result.extraction.grid.voxel_size;
  const double reach = (2 * epsilon + 2 * 8e-5) / (std::cos(0.02) - std::cos(0.6));
  for (const MedialSphere& s : result.extraction.spheres) {
    for (std::uint32_t coordinate : s.voxel) {
      EXPECT_LE(coordinate, resolution / 2);
      EXPECT_GE(coordinate, (resolution - 1) / 2);
    }
    EXPECT_LE(test::to_eigen(s.centre).norm(), reach);
    EXPECT_LE(s.radius, 1.0);
    EXPECT_GE(s.radius, 1.0 - 8e-5 - test::to_eigen(s.centre).norm());
  }
}

TEST(LoopBudget, SphereOfTwoHundredThousandTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  CertifiedExtraction result;
  expect_centre_found(40, 200000, result);
}

// Near the centre every cluster is listed; expand_clusters.comp takes an iteration for each, and one for every eight of
// its triangles, so not all of them in one dispatch.
TEST(LoopBudget, ClustersAreExpandedInRounds) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  CertifiedExtraction result;
  expect_centre_found(40, 300000, result);
  const ExtractionCounters::Level& level = result.extraction.measurements.counters.levels[0];
  ASSERT_GT(level.cluster_tests, 0u) << "no list holds clusters";
  const Mesh sphere = test::make_sphere(1, 300000);
  const Bvh bvh =
      Bvh::build({sphere.vertices, sphere.triangles, {}, true}, {.leaf_size = gpu::kMostLeafTriangles}).value();
  const auto clusters = make_clusters(bvh, {}, {}, 16, 8192);
  const std::uint32_t most = std::ranges::max_element(clusters, {}, &gpu::Cluster::count)->count;
  EXPECT_GT(clusters.size() * (1 + (most + 7) / 8), gpu::kEntriesPerRound) << "one round suffices";
}

// Voxels so large that the lists of kept cells are longer than the budget on average, so one at least is.
TEST(LoopBudget, ListsLongerThanTheBudget) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  CertifiedExtraction result;
  expect_centre_found(3, 200000, result);
  std::uint64_t longest_mean = 0;
  for (const ExtractionCounters::Level& level : result.extraction.measurements.counters.levels) {
    if (level.kept > 0) longest_mean = std::max(longest_mean, level.contacts / level.kept);
  }
  EXPECT_GT(longest_mean, kLoopBudget) << test::describe(result);
}

// Expanding the clusters of one cell, eight lanes at once, would take more than a budget of iterations.
TEST(LoopBudget, MoreTrianglesThanEightBudgets) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  CertifiedExtraction result;
  expect_centre_found(3, 600000, result);
}

}  // namespace
}  // namespace medial_vk
