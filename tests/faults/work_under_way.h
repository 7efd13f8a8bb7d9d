// The resources of submitted work, none of which may be destroyed before a call has waited for the work.
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

  /// A user of one resource also uses those that it refers to: a set of descriptors its buffers and its pool, a buffer
  /// its memory.
  void depends(Handle user, Handle used);
  void begin(VkCommandBuffer commands);
  void records(VkCommandBuffer commands, Handle used);
  /// Its recorded commands, and the semaphores for which it waits and that it signals.
  void submit(const VkSubmitInfo& info, VkFence fence);
  /// A wait has completed: for the work that signals this fence, or for all.
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
