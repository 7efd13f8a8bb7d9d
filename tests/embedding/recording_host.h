// A host that records jobs: its device is that of a context, lent in the way of a host.
#pragma once

#include <stdexcept>
#include <utility>

#include "device/context_impl.h"
#include "medial_vk/extraction_job.h"
#include "support/device/lend_device.h"

namespace medial_vk::test {

class RecordingHost {
 public:
  explicit RecordingHost(Context owner) : owner_(std::move(owner)) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = impl().queue_family;
    require(impl().vk.vkCreateCommandPool(impl().device, &pool, nullptr, &pool_));
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    require(impl().vk.vkAllocateCommandBuffers(impl().device, &allocation, &commands_));
  }
  RecordingHost(const RecordingHost&) = delete;
  RecordingHost& operator=(const RecordingHost&) = delete;
  ~RecordingHost() { impl().vk.vkDestroyCommandPool(impl().device, pool_, nullptr); }

  HostDevice lend() { return lend_device(impl()); }

  /// Records, submits, waits.
  Status run(ExtractionJob& job) {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    require(impl().vk.vkResetCommandBuffer(commands_, 0));
    require(impl().vk.vkBeginCommandBuffer(commands_, &begin));
    const Status recorded = job.record(commands_);
    require(impl().vk.vkEndCommandBuffer(commands_));
    if (!recorded.ok()) return recorded;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    require(impl().vk.vkQueueSubmit(impl().queue, 1, &info, VK_NULL_HANDLE));
    require(impl().vk.vkDeviceWaitIdle(impl().device));
    return {};
  }

 private:
  ContextImpl& impl() { return Internals::of(owner_); }
  static void require(VkResult result) {
    if (result != VK_SUCCESS) throw std::runtime_error("a call of Vulkan failed");
  }

  Context owner_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace medial_vk::test
