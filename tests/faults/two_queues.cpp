#include "two_queues.h"

#include <utility>

namespace medial_vk::test {

VkQueue TwoQueues::copying_queue() {
  static int place;
  return reinterpret_cast<VkQueue>(&place);
}

VkResult TwoQueues::submit(VkQueue queue, const VkSubmitInfo& info, VkFence fence, LateQueue late, const Submit& real,
                           const Report& report) {
  real_ = real;
  report_ = report;
  const Kept work{info.commandBufferCount != 0 ? info.pCommandBuffers[0] : VK_NULL_HANDLE,
                  info.waitSemaphoreCount != 0 ? info.pWaitSemaphores[0] : VK_NULL_HANDLE,
                  info.signalSemaphoreCount != 0 ? info.pSignalSemaphores[0] : VK_NULL_HANDLE, fence};
  const bool copies = queue == copying_queue();
  if (copies == (late == LateQueue::kCopies)) {
    kept_.push_back(work);
    return VK_SUCCESS;
  }
  return run(work);
}

// The real queue does one thing after the other, so semaphores are only followed here.
VkResult TwoQueues::run(const Kept& work) {
  if (work.waits != VK_NULL_HANDLE) {
    if (!signalled_.contains(work.waits) && !run_until_signalled(work.waits))
      report_("a submission waits for a semaphore that nobody has signalled");
    signalled_.erase(work.waits);
  }
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = work.commands != VK_NULL_HANDLE ? 1 : 0;
  info.pCommandBuffers = &work.commands;
  const VkResult result = real_(info, work.fence);
  if (work.signals != VK_NULL_HANDLE && !signalled_.insert(work.signals).second)
    report_("a semaphore is signalled twice");
  return result;
}

bool TwoQueues::run_until_signalled(VkSemaphore semaphore) {
  while (!kept_.empty() && !signalled_.contains(semaphore)) {
    const Kept first = kept_.front();
    kept_.erase(kept_.begin());
    run(first);
  }
  return signalled_.contains(semaphore);
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
