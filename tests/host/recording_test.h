// A fixture for tests of recorded commands: a host with a device of its own, under the validation layer if it is
// installed, that lends the device to a context.
#pragma once

#include <gtest/gtest.h>
#include <medial_vk/context.h>
#include <medial_vk/host_device.h>

#include <memory>
#include <utility>

#include "lent_device.h"
#include "support/device/device.h"
#include "vulkan_host.h"

namespace medial_vk::test {

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    vulkan_ = std::make_unique<VulkanHost>();
    auto info = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    info.queueFamilyIndex = vulkan_->queue_family;
    ASSERT_EQ(vkCreateCommandPool(vulkan_->device, &info, nullptr, &pool_), VK_SUCCESS);
  }
  void TearDown() override {
    if (!vulkan_) return;
    vkDestroyCommandPool(vulkan_->device, pool_, nullptr);
    EXPECT_EQ(vulkan_->validation_messages(), 0u);
  }

  Context adopt() {
    Result<Context> context = Context::adopt(lend(*vulkan_));
    EXPECT_TRUE(context.ok()) << context.error().message;
    return std::move(context).value();
  }

  VkCommandBuffer begin() {
    auto allocation = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    EXPECT_EQ(vkAllocateCommandBuffers(vulkan_->device, &allocation, &commands), VK_SUCCESS);
    const auto info = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    EXPECT_EQ(vkBeginCommandBuffer(commands, &info), VK_SUCCESS);
    return commands;
  }

  void end_and_submit(VkCommandBuffer commands) {
    EXPECT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
    auto info = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    EXPECT_EQ(vkQueueSubmit(vulkan_->queue, 1, &info, VK_NULL_HANDLE), VK_SUCCESS);
  }

  HostBuffer copy_of(VkCommandBuffer commands, VkBuffer from, VkDeviceSize bytes) {
    const HostBuffer to = vulkan_->create_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const VkBufferCopy region = {0, 0, bytes};
    vkCmdCopyBuffer(commands, from, to.handle, 1, &region);
    auto barrier = vulkan_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
    return to;
  }

  std::unique_ptr<VulkanHost> vulkan_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
};

}  // namespace medial_vk::test
