// Sequences that a job records, run on the device of a context, and buffers of the device as values.
#pragma once

#include <volk.h>

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "medial_vk/context.h"

namespace medial_vk::test {

class RecordedFrames {
 public:
  explicit RecordedFrames(Context& owner) : impl_(Internals::of(owner)) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = impl_.queue_family;
    require(impl_.vk.vkCreateCommandPool(impl_.device, &pool, nullptr, &pool_));
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    require(impl_.vk.vkAllocateCommandBuffers(impl_.device, &allocation, &commands_));
  }
  RecordedFrames(const RecordedFrames&) = delete;
  RecordedFrames& operator=(const RecordedFrames&) = delete;
  ~RecordedFrames() { impl_.vk.vkDestroyCommandPool(impl_.device, pool_, nullptr); }

  /// Records with `record`, submits, and waits for the end.
  void run(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    require(impl_.vk.vkBeginCommandBuffer(commands_, &info));
    record(commands_);
    require(impl_.vk.vkEndCommandBuffer(commands_));
    VkSubmitInfo submission{};
    submission.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submission.commandBufferCount = 1;
    submission.pCommandBuffers = &commands_;
    require(impl_.vk.vkQueueSubmit(impl_.queue, 1, &submission, VK_NULL_HANDLE));
    require(impl_.vk.vkQueueWaitIdle(impl_.queue));
  }

  template <class T>
  std::vector<T> read(VkBuffer from, std::size_t count) {
    const VkDeviceSize bytes = count * sizeof(T);
    Arena arena(impl_);
    const Buffer to = arena.create_buffer(bytes, MemoryKind::kReadback, "a test").value();
    copy({from, bytes, nullptr}, to, bytes);
    const auto* first = static_cast<const T*>(to.mapped);
    return {first, first + count};
  }

  template <class T>
  void write(VkBuffer to, const std::vector<T>& values) {
    const VkDeviceSize bytes = values.size() * sizeof(T);
    Arena arena(impl_);
    const Buffer from = arena.create_buffer(bytes, MemoryKind::kUpload, "a test").value();
    std::copy(values.begin(), values.end(), static_cast<T*>(from.mapped));
    copy(from, {to, bytes, nullptr}, bytes);
  }

 private:
  static void require(VkResult result) {
    if (result != VK_SUCCESS) throw std::runtime_error("a call of Vulkan failed in a test");
  }
  void copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes) {
    const auto done = run_commands(impl_, [&](Recorder& r) {
      r.copy(from, 0, to, 0, bytes);
      r.barrier_to_host();
      return r.status();
    });
    if (!done.ok()) throw std::runtime_error(done.error().message);
  }

  ContextImpl& impl_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace medial_vk::test
