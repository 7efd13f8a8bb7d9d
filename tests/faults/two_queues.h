// A device with one queue appears to have another one, of a family that only copies. One of the two runs as late as
// possible, so that work that should have waited for it, and did not, fails.
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

  /// Submissions to the late queue are kept until a call waits for them. Those to the other queue run at once, after
  /// the submissions for which they wait. `report` receives a wait for a semaphore that will never be signalled, a
  /// second signal, and submissions of a form that is not supported here.
  VkResult submit(VkQueue queue, const VkSubmitInfo& info, VkFence fence, LateQueue late, const Submit& real,
                  const Report& report);
  /// Runs all kept submissions, up to the one that signals this fence, or all of them.
  void run_until(std::optional<VkFence> fence);
  /// Forgets a destroyed semaphore, since another one may receive its handle.
  void forget(VkSemaphore semaphore) {
    signalled_.erase(semaphore);
    to_be_signalled_.erase(semaphore);
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
  std::set<VkSemaphore> signalled_;        // by submissions that have run
  std::set<VkSemaphore> to_be_signalled_;  // by submissions, and not consumed by a submitted wait
  Submit real_;
  Report report_;
};

}  // namespace medial_vk::test
