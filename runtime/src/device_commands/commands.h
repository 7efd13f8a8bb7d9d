// Command buffers: their recording, their submission to a queue of the device, and the wait for their end.
#pragma once

#include <volk.h>

#include <functional>
#include <optional>
#include <vector>

#include "device/internals.h"
#include "device_commands/recorder.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Orders two submissions on any queues: the second waits on the device until the first, and all before it on its
/// queue, have finished, and sees their writes. A signal must be waited for once before the next; if it never is, the
/// semaphore can only be destroyed. Created by the first call of prepare().
class Semaphore {
 public:
  explicit Semaphore(ContextImpl& context) : context_(&context) {}
  Semaphore(const Semaphore&) = delete;
  Semaphore& operator=(const Semaphore&) = delete;
  ~Semaphore();
  /// Error: kOutOfMemory.
  Status prepare();
  VkSemaphore handle() const { return handle_; }

 private:
  ContextImpl* context_;
  VkSemaphore handle_ = VK_NULL_HANDLE;
};

/// One reusable command buffer of one queue. The resources that it records must outlive it; its destructor waits for
/// pending commands.
class Commands {
 public:
  enum class Queue {
    kCompute,
    kTransfer,  // of the family that only copies; ContextImpl::transfer_queue is not null
  };
  /// For copies beside kernels: the latter queue if there is one.
  static Queue queue_for_transfers(const ContextImpl& context);
  explicit Commands(ContextImpl& context, Queue queue = Queue::kCompute) : context_(&context), queue_(queue) {}
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
  ~Commands();

  /// Starts a new recording; earlier submissions must have been waited for. Error: kOutOfMemory.
  Status begin();
  /// Of the recording since begin().
  Recorder& recorder() { return *recorder_; }
  /// Semaphores may be null. Errors: of the recorder; device lost (kInternal); kOutOfMemory. After an error nothing is
  /// pending.
  Status submit(const Semaphore* wait_for, const Semaphore* signal);
  /// Returns at once if nothing is pending. `while_waiting` is called every ten milliseconds. Errors: as submit().
  Status wait(const std::function<void()>& while_waiting = {});
  /// The same without a result, after another error.
  void drain() noexcept;

 private:
  Status create();
  void call_while_busy(const std::function<void()>& callback);

  ContextImpl* context_;
  Queue queue_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::optional<Recorder> recorder_;
  bool under_way_ = false;
};

/// Compiles the missing programs that `record` requires, on the threads of the context, since compiling them one by one
/// at their first use would take longer than a small job. `record` is called once, for a rehearsal. Errors: of
/// `record`, and of the programs.
Status make_programs(ContextImpl& context, const std::function<Status(Recorder&)>& record);

/// Records with `record`, submits, waits; returns seconds per stage. `while_waiting` is called every ten milliseconds
/// until the device is done. Errors: device lost (kInternal), kOutOfMemory, and those of `record`.
Result<std::vector<StageTime>> run_commands(ContextImpl& context, const std::function<Status(Recorder&)>& record,
                                            const std::function<void()>& while_waiting = {});

}  // namespace medial_vk
