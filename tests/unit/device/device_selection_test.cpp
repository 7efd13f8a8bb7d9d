// The device that a choice selects; needs no Vulkan.
#include "device/device_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace medial_vk {
namespace {

using testing::HasSubstr;

DeviceDescription device(std::uint32_t index, const char* name, const char* type) {
  DeviceDescription description;
  description.index = index;
  description.name = name;
  description.type = type;
  description.usable = true;
  return description;
}

std::vector<DeviceDescription> workstation() {
  std::vector<DeviceDescription> devices = {
      device(0, "llvmpipe (LLVM 15.0.6)", "cpu"), device(1, "Intel Iris Xe", "integrated"),
      device(2, "NVIDIA GeForce RTX 4090", "discrete"), device(3, "NVIDIA GeForce RTX 3060", "discrete"),
      device(4, "Old Card", "discrete")};
  devices[4].usable = false;
  devices[4].why_not = {"it has Vulkan 1.1.0, 1.2 is needed", "it has no compute queue"};
  return devices;
}

TEST(DeviceSelection, PrefersTheFirstDiscreteDevice) {
  const auto chosen = choose_device(workstation(), "", "device");
  ASSERT_TRUE(chosen.ok());
  EXPECT_EQ(chosen.value(), 2u);
}

TEST(DeviceSelection, RanksIntegratedVirtualAndCpu) {
  std::vector<DeviceDescription> devices = {device(0, "a", "other"), device(1, "b", "cpu"), device(2, "c", "virtual")};
  EXPECT_EQ(choose_device(devices, "", "device").value(), 2u);
  devices.push_back(device(3, "d", "integrated"));
  EXPECT_EQ(choose_device(devices, "", "device").value(), 3u);
  devices.resize(2);
  EXPECT_EQ(choose_device(devices, "", "device").value(), 1u);
}

TEST(DeviceSelection, TakesAnIndex) { EXPECT_EQ(choose_device(workstation(), "0", "device").value(), 0u); }

TEST(DeviceSelection, TakesPartOfANameInAnyCase) {
  EXPECT_EQ(choose_device(workstation(), "LLVMPipe", "device").value(), 0u);
  EXPECT_EQ(choose_device(workstation(), "rtx 30", "device").value(), 3u);
}

TEST(DeviceSelection, OfSeveralNamesTakesTheBest) {
  const std::vector<DeviceDescription> devices = {device(0, "Card (software)", "cpu"), device(1, "Card", "discrete")};
  EXPECT_EQ(choose_device(devices, "card", "device").value(), 1u);
}

TEST(DeviceSelection, ANumberBeyondTheIndicesMayBePartOfAName) {
  EXPECT_EQ(choose_device(workstation(), "4090", "device").value(), 2u);
}

TEST(DeviceSelection, UnknownChoiceListsWhatExists) {
  const auto chosen = choose_device(workstation(), "Radeon", "MEDIAL_VK_DEVICE");
  ASSERT_FALSE(chosen.ok());
  EXPECT_EQ(chosen.error().code, ErrorCode::kNoDevice);
  EXPECT_THAT(chosen.error().message, HasSubstr("MEDIAL_VK_DEVICE \"Radeon\""));
  EXPECT_THAT(chosen.error().message, HasSubstr("2: NVIDIA GeForce RTX 4090 (discrete)"));
}

TEST(DeviceSelection, UnusableDeviceSaysWhy) {
  for (const char* choice : {"4", "old card"}) {
    const auto chosen = choose_device(workstation(), choice, "device");
    ASSERT_FALSE(chosen.ok());
    EXPECT_EQ(chosen.error().code, ErrorCode::kNoDevice);
    EXPECT_THAT(chosen.error().message, HasSubstr("it has Vulkan 1.1.0, 1.2 is needed; it has no compute queue"));
  }
}

TEST(DeviceSelection, NoDeviceAtAll) {
  for (const char* choice : {"", "0", "any"}) {
    const auto chosen = choose_device({}, choice, "device");
    ASSERT_FALSE(chosen.ok());
    EXPECT_EQ(chosen.error().code, ErrorCode::kNoDevice);
  }
}

VkQueueFamilyProperties family(VkQueueFlags flags, std::uint32_t count = 1) {
  return {.queueFlags = flags, .queueCount = count, .timestampValidBits = 64, .minImageTransferGranularity = {1, 1, 1}};
}

TEST(TransferFamily, IsOneThatOnlyCopies) {
  constexpr VkQueueFlags kAll = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  constexpr VkQueueFlags kCopies = VK_QUEUE_TRANSFER_BIT | VK_QUEUE_SPARSE_BINDING_BIT;
  constexpr VkQueueFlags kCompute = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  constexpr VkQueueFlags kVideo = VK_QUEUE_TRANSFER_BIT | 0x20;  // VK_QUEUE_VIDEO_DECODE_BIT_KHR
  using Families = std::vector<VkQueueFamilyProperties>;
  EXPECT_EQ(choose_transfer_family(Families{family(kAll)}), std::nullopt);
  EXPECT_EQ(choose_transfer_family(Families{family(kAll), family(kCompute)}), std::nullopt);
  EXPECT_EQ(choose_transfer_family(Families{family(kAll), family(kVideo)}), std::nullopt);
  EXPECT_EQ(choose_transfer_family(Families{family(kAll), family(kVideo), family(kCopies), family(kCompute)}), 2u);
  EXPECT_EQ(choose_transfer_family(Families{family(kAll), family(kCopies, 0), family(VK_QUEUE_TRANSFER_BIT)}), 2u);
  EXPECT_EQ(choose_transfer_family(Families{}), std::nullopt);
}

}  // namespace
}  // namespace medial_vk
