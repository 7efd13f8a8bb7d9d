#include <cstdint>

#include "context_impl.h"
#include "recorder.h"

namespace medial_vk {
namespace {

/// A command pool with one command buffer, and a fence; freed at the end of the scope.
class Submission {
 public:
  explicit Submission(Context::Impl& context) : context_(context) {}
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;
  ~Submission() {
    context_.vk.vkDestroyFence(context_.device, fence_, context_.allocation_callbacks);
    context_.vk.vkDestroyCommandPool(context_.device, pool_, context_.allocation_callbacks);
  }

  VkCommandBuffer commands() const { return commands_; }
  Status begin();
  Status submit_and_wait(const std::function<void()>& while_waiting);
  void call_while_busy(const std::function<void()>& callback);

 private:
  Context::Impl& context_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

Status Submission::begin() {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool_info.queueFamilyIndex = context_.queue_family;
  VkResult result = context_.vk.vkCreateCommandPool(context_.device, &pool_info, context_.allocation_callbacks, &pool_);
  if (result != VK_SUCCESS) return vulkan_error("vkCreateCommandPool", result);

  VkCommandBufferAllocateInfo buffer_info{};
  buffer_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  buffer_info.commandPool = pool_;
  buffer_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer_info.commandBufferCount = 1;
  result = context_.vk.vkAllocateCommandBuffers(context_.device, &buffer_info, &commands_);
  if (result != VK_SUCCESS) return vulkan_error("vkAllocateCommandBuffers", result);

  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  result = context_.vk.vkCreateFence(context_.device, &fence_info, context_.allocation_callbacks, &fence_);
  if (result != VK_SUCCESS) return vulkan_error("vkCreateFence", result);

  VkCommandBufferBeginInfo begin_info{};
  begin_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin_info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  result = context_.vk.vkBeginCommandBuffer(commands_, &begin_info);
  if (result != VK_SUCCESS) return vulkan_error("vkBeginCommandBuffer", result);
  return {};
}

/// After a wait that failed, for want of memory say: the device is still at work on buffers that are about to go, and
/// what is submitted cannot be taken back. A wait that fails again and again is given up.
void finish(const Context::Impl& context) {
  for (int attempt = 0; attempt < 16; ++attempt) {
    const VkResult result = context.vk.vkDeviceWaitIdle(context.device);
    if (result == VK_SUCCESS || result == VK_ERROR_DEVICE_LOST) return;
  }
}

Error submission_error(const Context::Impl& context, const char* call, VkResult result) {
  if (result != VK_ERROR_DEVICE_LOST) return vulkan_error(call, result);
  return {ErrorCode::kInternal, "the device \"" + context.description.name + "\" was lost while it computed (" + call +
                                    "): its driver crashed, or stopped a dispatch that took too long; try another "
                                    "device or a smaller memory budget"};
}

// If it throws, what the device uses must not be destroyed before the device is done.
void Submission::call_while_busy(const std::function<void()>& callback) {
  try {
    callback();
  } catch (...) {
    finish(context_);
    throw;
  }
}

Status Submission::submit_and_wait(const std::function<void()>& while_waiting) {
  VkResult result = context_.vk.vkEndCommandBuffer(commands_);
  if (result != VK_SUCCESS) return vulkan_error("vkEndCommandBuffer", result);
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  result = context_.vk.vkQueueSubmit(context_.queue, 1, &info, fence_);
  if (result != VK_SUCCESS) return submission_error(context_, "vkQueueSubmit", result);

  // No deadline: a slow CPU under a debugger or a sanitizer may take as long as it likes, what is submitted cannot be
  // taken back, and a device that hangs is reported as lost by its driver.
  constexpr std::uint64_t kMinute = 60'000'000'000ull, kMoment = 10'000'000ull;
  for (;;) {
    result = context_.vk.vkWaitForFences(context_.device, 1, &fence_, VK_TRUE, while_waiting ? kMoment : kMinute);
    if (result != VK_TIMEOUT) break;
    if (while_waiting) call_while_busy(while_waiting);
  }
  if (result != VK_SUCCESS) {
    if (result != VK_ERROR_DEVICE_LOST) finish(context_);
    return submission_error(context_, "vkWaitForFences", result);
  }
  return {};
}

}  // namespace

Status make_programs(Context::Impl& context, const std::function<Status(Recorder&)>& record) {
  Recorder rehearsal(context);
  if (Status s = record(rehearsal); !s.ok()) return s;
  return context.make_programs(rehearsal.programs());
}

Result<std::vector<StageTime>> run_commands(Context::Impl& context, const std::function<Status(Recorder&)>& record,
                                            const std::function<void()>& while_waiting) {
  Submission submission(context);
  if (const Status begun = submission.begin(); !begun.ok()) return begun.error();
  Recorder recorder(context, submission.commands());  // its pools must outlive the wait
  if (const Status recorded = record(recorder); !recorded.ok()) return recorded.error();
  recorder.end_stages();
  if (const Status recorded = recorder.status(); !recorded.ok()) return recorded.error();
  if (const Status ran = submission.submit_and_wait(while_waiting); !ran.ok()) return ran.error();
  return recorder.stage_times();
}

}  // namespace medial_vk
