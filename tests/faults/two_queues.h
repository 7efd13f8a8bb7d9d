// A device with one queue seems to have another one, of a family that only copies; and one of the two is as late as it
// may be, so that what should have waited for it, and did not, goes wrong.
#pragma once

#include <volk.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace medial_vk::test {

enum class LateQueue { kCopies, kKernels };

class TwoQueues {
 public:
  static constexpr std::uint32_t kCopyingFamily = 1;  // the real device has family 0
  using Submit = std::function<VkResult(const VkSubmitInfo& info, VkFence fence)>;
  using Report = std::function<void(std::string)>;

  static VkQueue copying_queue();

  /// What the late queue is given is kept until somebody waits for it. The other queue's runs at once, after what it
  /// waits for. `report`: a wait for a semaphore that nobody will have signalled, a second signal, submissions of a
  /// form that is not followed here.
  VkResult submit(VkQueue queue, const VkSubmitInfo& info, VkFence fence, LateQueue late, const Submit& real,
                  const Report& report);
  /// Runs all that was kept, up to what signals this fence, or all of it.
  void run_until(std::optional<VkFence> fence);
  /// A semaphore that is destroyed: another one may get its handle.
  void forget(VkSemaphore semaphore) {
    signalled_.erase(semaphore);
    promised_.erase(semaphore);
  }
  bool is_idle() const { return kept_.empty(); }

 private:
  struct Kept {
    VkCommandBuffer commands;
    VkSemaphore waits, signals;  // or null
    VkFence fence;
  };
  VkResult run(const Kept& work);
  void run_until_signalled(VkSemaphore semaphore);

  std::vector<Kept> kept_;
  std::set<VkSemaphore> signalled_;  // by what has run
  std::set<VkSemaphore> promised_;   // by what was submitted, and not taken by a wait that was
  Submit real_;
  Report report_;
};

}  // namespace medial_vk::test
