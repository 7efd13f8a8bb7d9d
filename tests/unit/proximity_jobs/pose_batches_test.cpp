// Batches of poses on a device: in one block of memory of the host and the device, or copied.
#include "proximity_jobs/pose_batches.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "medial_vk/device_bodies.h"
#include "proximity_jobs/device_bodies_impl.h"
#include "support/device/device_test.h"

namespace medial_vk {
namespace {

class PoseBatchesTest : public test::DeviceTest {};

std::vector<PosedPair> poses_along_a_line(std::size_t count) {
  std::vector<PosedPair> pairs;
  for (std::size_t i = 0; i < count; ++i)
    pairs.push_back({make_pose({0.01 * static_cast<double>(i), 0, 0}, {0, 0, 0}), 0, 0});
  return pairs;
}

// As on a device with memory of its own: two batches in progress, with copies.
TEST_F(PoseBatchesTest, GiveTheSameWithCopies) {
  const std::vector<Ball> inside = {{{0, 0, 0}, 1}, {{1, 0, 0}, 0.5}}, cover = {{{0, 0, 0}, 2}};
  const Body bodies[] = {Body::create(inside, cover).value()};
  DeviceBodies on_device = DeviceBodies::create(*context_, bodies).value(),
               copying = DeviceBodies::create(*context_, bodies).value();
  Internals::of(copying).batches = std::make_unique<PoseBatches>(Internals::of(copying), 64, false);
  for (const std::size_t count : {1, 64, 65, 500}) {
    const std::vector<PosedPair> pairs = poses_along_a_line(count);
    std::vector<DistanceBounds> expected(count), found(count);
    ASSERT_TRUE(on_device.distance_bounds(pairs, expected).ok());
    ASSERT_TRUE(copying.distance_bounds(pairs, found).ok());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(found[i].lower, expected[i].lower) << i;
      EXPECT_EQ(found[i].upper, expected[i].upper) << i;
      EXPECT_EQ(found[i].inside_pair, expected[i].inside_pair) << i;
    }
  }
}

}  // namespace
}  // namespace medial_vk
