// The conversion of Vulkan's results: the error code, and words instead of numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(VulkanError, MemoryIsDistinguishedFromOtherFailures) {
  for (const VkResult result : {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY}) {
    EXPECT_EQ(vulkan_error("vkAllocateMemory", result).code, ErrorCode::kOutOfMemory);
  }
  const Error lost = vulkan_error("vkQueueSubmit", VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(lost.code, ErrorCode::kInternal);
  EXPECT_EQ(lost.message, "vkQueueSubmit failed: the device was lost");
}

TEST(VulkanError, ResultsThatDriversReturnAreWords) {
  for (const VkResult result :
       {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_INITIALIZATION_FAILED,
        VK_ERROR_DEVICE_LOST, VK_ERROR_MEMORY_MAP_FAILED, VK_ERROR_LAYER_NOT_PRESENT, VK_ERROR_EXTENSION_NOT_PRESENT,
        VK_ERROR_FEATURE_NOT_PRESENT, VK_ERROR_INCOMPATIBLE_DRIVER, VK_ERROR_TOO_MANY_OBJECTS, VK_ERROR_FRAGMENTED_POOL,
        VK_ERROR_OUT_OF_POOL_MEMORY, VK_ERROR_INVALID_SHADER_NV}) {
    EXPECT_THAT(vulkan_error("vkCall", result).message, Not(HasSubstr("VkResult"))) << result;
  }
  EXPECT_EQ(vulkan_error("vkCall", VK_ERROR_UNKNOWN).message, "vkCall failed: VkResult -13");
}

}  // namespace
}  // namespace medial_vk
