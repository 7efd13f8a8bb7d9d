// The two variants of the kernels in which eight lanes work on one cell (shaders/shared/lanes/lanes.glsl): with
// shuffles, and through shared memory, for devices without lockstep.
#include <gtest/gtest.h>

#include <cstring>

#include "device/context_impl.h"
#include "medial_vk/extraction.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

void expect_the_same(Mesh solid, std::uint32_t resolution) {
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(std::move(solid));
  ExtractionOptions options;
  options.resolution = resolution;
  Context context = test::make_context();
  if (!Internals::of(context).has_lockstep_lanes) GTEST_SKIP() << "the device has no lanes in lockstep";
  const Extraction shuffled = test::extract_on_device(context, mesh, options).extraction;
  Internals::of(context).has_lockstep_lanes = false;
  const Extraction shared = test::extract_on_device(context, mesh, options).extraction;
  EXPECT_EQ(context.validation_messages(), 0u);
  ASSERT_GT(shuffled.spheres.size(), 500u);
  ASSERT_EQ(shuffled.spheres.size(), shared.spheres.size());
  for (std::size_t i = 0; i < shared.spheres.size(); ++i)
    EXPECT_EQ(std::memcmp(&shuffled.spheres[i], &shared.spheres[i], sizeof(MedialSphere)), 0) << "sphere " << i;
  EXPECT_EQ(shuffled.measurements.counters.undecided, shared.measurements.counters.undecided);
  ASSERT_EQ(shuffled.measurements.counters.levels.size(), shared.measurements.counters.levels.size());
  for (std::size_t level = 0; level < shared.measurements.counters.levels.size(); ++level)
    EXPECT_EQ(shuffled.measurements.counters.levels[level].kept, shared.measurements.counters.levels[level].kept)
        << "level " << level;
}

TEST(Lanes, SharedMemoryGivesTheSameAsShuffles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(test::make_l_shape(1.0, 0.4, 0.5), 30);
}

TEST(Lanes, SharedMemoryGivesTheSameWhereListsHoldClusters) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(test::make_torus(1.0, 0.4, 80, 160, 0.5), 65);
}

}  // namespace
}  // namespace medial_vk
