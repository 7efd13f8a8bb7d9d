// Command buffers: recorded, submitted to a queue of the device, waited for.
#pragma once

#include <volk.h>

#include <functional>
#include <optional>
#include <vector>

#include "commands/recorder.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Orders two submissions on any queues: the second waits on the device until the first, and all before it on its
/// queue, are done, and sees what they wrote. A signal is waited for once, before the next; or never, and then all that
/// is left for the semaphore is destruction. Made with the first call of prepare().
class Semaphore {
 public:
  explicit Semaphore(Context::Impl& context) : context_(&context) {}
  Semaphore(const Semaphore&) = delete;
  Semaphore& operator=(const Semaphore&) = delete;
  ~Semaphore();
  /// Error: kOutOfMemory.
  Status prepare();
  VkSemaphore handle() const { return handle_; }

 private:
  Context::Impl* context_;
  VkSemaphore handle_ = VK_NULL_HANDLE;
};

/// One command buffer of one queue, to be used again and again. What it records must not go before it does; if it is
/// under way, it waits at the end of its scope.
class Commands {
 public:
  enum class Queue {
    kCompute,
    kTransfer,  // of the family that only copies; Context::Impl::transfer_queue is not null
  };
  /// For copies beside kernels: the latter queue if there is one.
  static Queue queue_for_transfers(const Context::Impl& context);
  explicit Commands(Context::Impl& context, Queue queue = Queue::kCompute) : context_(&context), queue_(queue) {}
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
  ~Commands();

  /// Starts a new recording; what was submitted before must have been waited for. Error: kOutOfMemory.
  Status begin();
  /// Of the recording since begin().
  Recorder& recorder() { return *recorder_; }
  /// Semaphores may be null. Errors: of the recorder; device lost (kInternal); kOutOfMemory. Nothing is under way then.
  Status submit(const Semaphore* wait_for, const Semaphore* signal);
  /// Returns at once if nothing is under way. `while_waiting` is called every ten milliseconds. Errors: as submit().
  Status wait(const std::function<void()>& while_waiting = {});
  /// The same where nobody can be told: on the way out of an error.
  void drain() noexcept;

 private:
  Status create();
  void call_while_busy(const std::function<void()>& callback);

  Context::Impl* context_;
  Queue queue_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::optional<Recorder> recorder_;
  bool under_way_ = false;
};

/// Makes the programs that `record` needs and that are not there yet, on all processors: compiling them one by one as
/// they are met takes longer than a small job. `record` is called once, for a rehearsal. Errors: of `record`, and of
/// the programs.
Status make_programs(Context::Impl& context, const std::function<Status(Recorder&)>& record);

/// Records with `record`, submits, waits; returns seconds per stage. `while_waiting` is called every ten milliseconds
/// until the device is done. Errors: device lost (kInternal), kOutOfMemory, whatever `record` returns.
Result<std::vector<StageTime>> run_commands(Context::Impl& context, const std::function<Status(Recorder&)>& record,
                                            const std::function<void()>& while_waiting = {});

}  // namespace medial_vk
