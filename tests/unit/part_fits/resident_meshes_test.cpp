// Meshes of several parts on a device whose memory may not hold them all.
#include "part_fits/resident_meshes.h"

#include <gtest/gtest.h>

#include <memory>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// A device with room for some meshes.
struct Device {
  int room, resident = 0, uploads = 0;
};

struct OnDevice {
  Device& device;
  explicit OnDevice(Device& on) : device(on) {
    ++device.resident;
    ++device.uploads;
  }
  ~OnDevice() { --device.resident; }
  OnDevice(const OnDevice&) = delete;
  OnDevice& operator=(const OnDevice&) = delete;
};

/// Extractors that keep a mesh on the device once they have been called, unless there is no room.
Extractor extractor_on(Device& device) {
  return [&device, mesh = std::make_shared<std::unique_ptr<OnDevice>>()](const auto&...) -> Result<Extraction> {
    if (*mesh) return Extraction();
    if (device.resident >= device.room) return Error{ErrorCode::kOutOfMemory, "no room"};
    *mesh = std::make_unique<OnDevice>(device);
    return Extraction();
  };
}

class ResidentMeshesTest : public testing::Test {
 protected:
  Result<Extraction> extract(const Extractor& extractor) const { return extractor(mesh_, {}, {}, {}); }

  IndexedMesh mesh_ = IndexedMesh::build(prepare_mesh(test::make_box({1, 1, 1})).value()).value();
};

TEST_F(ResidentMeshesTest, EachIsUploadedOnceAndLeavesWithItsExtractor) {
  Device device = {2};
  ResidentMeshes meshes([&] { return extractor_on(device); });
  const Extractor first = meshes.extractor();
  {
    const Extractor second = meshes.extractor();
    EXPECT_EQ(device.uploads, 0);
    for (int turn = 0; turn < 3; ++turn) {
      ASSERT_TRUE(extract(first).ok());
      ASSERT_TRUE(extract(second).ok());
    }
    EXPECT_EQ(device.uploads, 2);
    EXPECT_EQ(device.resident, 2);
  }
  EXPECT_EQ(device.resident, 1);
}

TEST_F(ResidentMeshesTest, OthersMakeRoom) {
  Device device = {1};
  ResidentMeshes meshes([&] { return extractor_on(device); });
  const Extractor first = meshes.extractor(), second = meshes.extractor();
  ASSERT_TRUE(extract(first).ok());
  ASSERT_TRUE(extract(second).ok());
  ASSERT_TRUE(extract(first).ok());
  EXPECT_EQ(device.uploads, 3);
  EXPECT_EQ(device.resident, 1);
  device.room = 0;
  ASSERT_TRUE(extract(first).ok());
  EXPECT_EQ(extract(second).error().code, ErrorCode::kOutOfMemory);
}

}  // namespace
}  // namespace medial_vk
