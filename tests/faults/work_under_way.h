// What submitted work uses until somebody has waited for it: none of that may be destroyed.
#pragma once

#include <volk.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>

namespace medial_vk::test {

class WorkUnderWay {
 public:
  using Handle = std::uint64_t;
  template <class T>
  static Handle handle(T vulkan_handle) {
    return reinterpret_cast<Handle>(vulkan_handle);
  }

  /// Whoever uses the one uses the other: a set of descriptors its buffers, and its pool; a buffer its memory.
  void depends(Handle user, Handle used);
  void begin(VkCommandBuffer commands);
  void records(VkCommandBuffer commands, Handle used);
  /// What it records, and the semaphores that it waits for and signals.
  void submit(const VkSubmitInfo& info, VkFence fence);
  /// Waited for: what signals this fence, or all.
  void finished(std::optional<VkFence> fence);
  bool uses(Handle used) const;
  void destroyed(Handle used);

 private:
  void add_with_all_it_uses(Handle used, std::set<Handle>& all) const;

  mutable std::mutex mutex_;
  std::map<Handle, std::set<Handle>> dependencies_;
  std::map<VkCommandBuffer, std::set<Handle>> recorded_;
  std::map<VkFence, std::set<Handle>> under_way_;
};

}  // namespace medial_vk::test
