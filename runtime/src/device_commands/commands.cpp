#include "device_commands/commands.h"

#include <cstdint>
#include <utility>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

Error submission_error(const ContextImpl& context, const char* call, VkResult result) {
  if (result != VK_ERROR_DEVICE_LOST) return vulkan_error(call, result);
  return {ErrorCode::kInternal, "the device \"" + context.description.name + "\" was lost while it computed (" + call +
                                    "): its driver crashed, or stopped a dispatch that took too long; choose "
                                    "another `device` or lower `memory_budget`"};
}

}  // namespace

Status Semaphore::prepare() {
  if (handle_ != VK_NULL_HANDLE) return {};
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  const VkResult result =
      context_->vk.vkCreateSemaphore(context_->device, &info, context_->allocation_callbacks, &handle_);
  if (result != VK_SUCCESS) return vulkan_error("vkCreateSemaphore", result);
  return {};
}

Semaphore::~Semaphore() { context_->vk.vkDestroySemaphore(context_->device, handle_, context_->allocation_callbacks); }

Commands::Queue Commands::queue_for_transfers(const ContextImpl& context) {
  return context.transfer_queue != VK_NULL_HANDLE ? Queue::kTransfer : Queue::kCompute;
}

Commands::~Commands() {
  drain();
  recorder_.reset();
  context_->vk.vkDestroyFence(context_->device, fence_, context_->allocation_callbacks);
  context_->vk.vkDestroyCommandPool(context_->device, pool_, context_->allocation_callbacks);
}

/// Objects of an earlier call that failed are kept.
Status Commands::create() {
  const VolkDeviceTable& vk = context_->vk;
  if (pool_ == VK_NULL_HANDLE) {
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    info.queueFamilyIndex = queue_ == Queue::kTransfer ? context_->transfer_family : context_->queue_family;
    const VkResult result = vk.vkCreateCommandPool(context_->device, &info, context_->allocation_callbacks, &pool_);
    if (result != VK_SUCCESS) return vulkan_error("vkCreateCommandPool", result);
  }
  if (fence_ == VK_NULL_HANDLE) {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    const VkResult result = vk.vkCreateFence(context_->device, &info, context_->allocation_callbacks, &fence_);
    if (result != VK_SUCCESS) return vulkan_error("vkCreateFence", result);
  }
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool_;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  const VkResult result = vk.vkAllocateCommandBuffers(context_->device, &info, &buffer_);
  if (result != VK_SUCCESS) return vulkan_error("vkAllocateCommandBuffers", result);
  return {};
}

Status Commands::begin() {
  recorder_.reset();
  const VolkDeviceTable& vk = context_->vk;
  if (buffer_ == VK_NULL_HANDLE) {
    if (Status created = create(); !created.ok()) return created;
  } else {
    VkResult result = vk.vkResetCommandPool(context_->device, pool_, 0);
    if (result != VK_SUCCESS) return vulkan_error("vkResetCommandPool", result);
    result = vk.vkResetFences(context_->device, 1, &fence_);
    if (result != VK_SUCCESS) return vulkan_error("vkResetFences", result);
  }
  VkCommandBufferBeginInfo begin_info{};
  begin_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin_info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  const VkResult result = vk.vkBeginCommandBuffer(buffer_, &begin_info);
  if (result != VK_SUCCESS) return vulkan_error("vkBeginCommandBuffer", result);
  recorder_.emplace(*context_, buffer_);
  if (queue_ == Queue::kTransfer) recorder_->only_transfer();
  return {};
}

Status Commands::submit(const Semaphore* wait_for, const Semaphore* signal) {
  recorder_->end_stages();
  if (Status recorded = recorder_->status(); !recorded.ok()) return recorded;
  VkResult result = context_->vk.vkEndCommandBuffer(buffer_);
  if (result != VK_SUCCESS) return vulkan_error("vkEndCommandBuffer", result);
  const VkPipelineStageFlags waiting_stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
  const VkSemaphore waits[] = {wait_for != nullptr ? wait_for->handle() : VK_NULL_HANDLE};
  const VkSemaphore signals[] = {signal != nullptr ? signal->handle() : VK_NULL_HANDLE};
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.waitSemaphoreCount = wait_for != nullptr ? 1 : 0;
  info.pWaitSemaphores = waits;
  info.pWaitDstStageMask = &waiting_stages;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &buffer_;
  info.signalSemaphoreCount = signal != nullptr ? 1 : 0;
  info.pSignalSemaphores = signals;
  const VkQueue queue = queue_ == Queue::kTransfer ? context_->transfer_queue : context_->queue;
  result = context_->vk.vkQueueSubmit(queue, 1, &info, fence_);
  if (result != VK_SUCCESS) return submission_error(*context_, "vkQueueSubmit", result);
  under_way_ = true;
  return {};
}

// If it throws, resources in use must not be destroyed before the device has finished.
void Commands::call_while_busy(const std::function<void()>& callback) {
  try {
    callback();
  } catch (...) {
    drain();
    throw;
  }
}

// By its own fence, as other work of a host's device must not be waited for. A wait may fail for lack of memory, but
// the device still uses resources that are about to be destroyed, and a submission cannot be revoked. After repeated
// failures the wait is given up.
void Commands::drain() noexcept {
  for (int attempt = 0; under_way_ && attempt < 16; ++attempt) {
    constexpr std::uint64_t kForever = ~std::uint64_t{0};
    const VkResult result = context_->vk.vkWaitForFences(context_->device, 1, &fence_, VK_TRUE, kForever);
    if (result == VK_SUCCESS || result == VK_ERROR_DEVICE_LOST) break;
  }
  under_way_ = false;
}

Status Commands::wait(const std::function<void()>& while_waiting) {
  if (!under_way_) return {};
  // No deadline: a CPU under a debugger or a sanitizer may be arbitrarily slow, a submission cannot be revoked, and the
  // driver reports a device that hangs as lost.
  constexpr std::uint64_t kMinute = 60'000'000'000ull, kMoment = 10'000'000ull;
  VkResult result = VK_TIMEOUT;
  for (;;) {
    result = context_->vk.vkWaitForFences(context_->device, 1, &fence_, VK_TRUE, while_waiting ? kMoment : kMinute);
    if (result != VK_TIMEOUT) break;
    if (while_waiting) call_while_busy(while_waiting);
  }
  if (result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST) drain();
  under_way_ = false;
  if (result == VK_SUCCESS) return {};
  return submission_error(*context_, "vkWaitForFences", result);
}

Status make_programs(ContextImpl& context, const std::function<Status(Recorder&)>& record) {
  Recorder rehearsal(context);
  if (Status s = record(rehearsal); !s.ok()) return s;
  return context.make_programs(rehearsal.programs());
}

Result<std::vector<StageTime>> run_commands(ContextImpl& context, const std::function<Status(Recorder&)>& record,
                                            const std::function<void()>& while_waiting) {
  Commands commands(context);
  if (const Status begun = commands.begin(); !begun.ok()) return begun.error();
  if (const Status recorded = record(commands.recorder()); !recorded.ok()) return recorded.error();
  if (const Status submitted = commands.submit(nullptr, nullptr); !submitted.ok()) return submitted.error();
  if (const Status done = commands.wait(while_waiting); !done.ok()) return done.error();
  return commands.recorder().stage_times();
}

}  // namespace medial_vk
