#include "two_queues.h"

#include <utility>

namespace medial_vk::test {

VkQueue TwoQueues::copying_queue() {
  static int marker;
  return reinterpret_cast<VkQueue>(&marker);
}

VkResult TwoQueues::submit(VkQueue queue, const VkSubmitInfo& info, VkFence fence, LateQueue late, const Submit& real,
                           const Report& report) {
  real_ = real;
  report_ = report;
  if (info.commandBufferCount > 1 || info.waitSemaphoreCount > 1 || info.signalSemaphoreCount > 1)
    report("a submission of more than one command buffer or semaphore");
  const Kept work{info.commandBufferCount != 0 ? info.pCommandBuffers[0] : VK_NULL_HANDLE,
                  info.waitSemaphoreCount != 0 ? info.pWaitSemaphores[0] : VK_NULL_HANDLE,
                  info.signalSemaphoreCount != 0 ? info.pSignalSemaphores[0] : VK_NULL_HANDLE, fence};
  // The semaphores that a submission waits for have been submitted before it.
  if (work.waits != VK_NULL_HANDLE && to_be_signalled_.erase(work.waits) == 0)
    report("a submission waits for a semaphore that no submission signals");
  if (work.signals != VK_NULL_HANDLE && !to_be_signalled_.insert(work.signals).second)
    report("a semaphore is signalled twice");
  const bool copies = queue == copying_queue();
  if (copies == (late == LateQueue::kCopies)) {
    kept_.push_back(work);
    return VK_SUCCESS;
  }
  return run(work);
}

// The real queue executes its work in order, so semaphores are only tracked here.
VkResult TwoQueues::run(const Kept& work) {
  if (work.waits != VK_NULL_HANDLE) {
    if (!signalled_.contains(work.waits)) run_until_signalled(work.waits);
    signalled_.erase(work.waits);
  }
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = work.commands != VK_NULL_HANDLE ? 1 : 0;
  info.pCommandBuffers = &work.commands;
  const VkResult result = real_(info, work.fence);
  if (result != VK_SUCCESS) report_("the kept submissions could not be submitted");
  if (work.signals != VK_NULL_HANDLE) signalled_.insert(work.signals);
  return result;
}

void TwoQueues::run_until_signalled(VkSemaphore semaphore) {
  while (!kept_.empty() && !signalled_.contains(semaphore)) {
    const Kept first = kept_.front();
    kept_.erase(kept_.begin());
    run(first);
  }
}

void TwoQueues::run_until(std::optional<VkFence> fence) {
  bool there = !fence;
  for (const Kept& work : kept_) there = there || work.fence == *fence;
  while (there && !kept_.empty()) {
    const Kept first = kept_.front();
    kept_.erase(kept_.begin());
    run(first);
    if (fence && first.fence == *fence) return;
  }
}

}  // namespace medial_vk::test
