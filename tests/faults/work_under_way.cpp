#include "work_under_way.h"

#include <algorithm>

namespace medial_vk::test {

void WorkUnderWay::depends(Handle user, Handle used) {
  const std::lock_guard lock(mutex_);
  dependencies_[user].insert(used);
}

void WorkUnderWay::begin(VkCommandBuffer commands) {
  const std::lock_guard lock(mutex_);
  recorded_[commands].clear();
}

void WorkUnderWay::records(VkCommandBuffer commands, Handle used) {
  const std::lock_guard lock(mutex_);
  recorded_[commands].insert(used);
}

void WorkUnderWay::add_with_all_it_uses(Handle used, std::set<Handle>& all) const {
  if (!all.insert(used).second) return;
  const auto found = dependencies_.find(used);
  if (found == dependencies_.end()) return;
  for (const Handle next : found->second) add_with_all_it_uses(next, all);
}

void WorkUnderWay::submit(const VkSubmitInfo& info, VkFence fence) {
  const std::lock_guard lock(mutex_);
  std::set<Handle>& all = under_way_[fence];
  all.insert(handle(fence));
  for (std::uint32_t i = 0; i < info.waitSemaphoreCount; ++i) all.insert(handle(info.pWaitSemaphores[i]));
  for (std::uint32_t i = 0; i < info.signalSemaphoreCount; ++i) all.insert(handle(info.pSignalSemaphores[i]));
  for (std::uint32_t i = 0; i < info.commandBufferCount; ++i) {
    const VkCommandBuffer commands = info.pCommandBuffers[i];
    add_with_all_it_uses(handle(commands), all);
    for (const Handle used : recorded_[commands]) add_with_all_it_uses(used, all);
  }
}

void WorkUnderWay::finished(std::optional<VkFence> fence) {
  const std::lock_guard lock(mutex_);
  if (fence)
    under_way_.erase(*fence);
  else
    under_way_.clear();
}

bool WorkUnderWay::uses(Handle used) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(under_way_.begin(), under_way_.end(), [used](const auto& w) { return w.second.contains(used); });
}

void WorkUnderWay::destroyed(Handle used) {
  const std::lock_guard lock(mutex_);
  dependencies_.erase(used);
}

}  // namespace medial_vk::test
