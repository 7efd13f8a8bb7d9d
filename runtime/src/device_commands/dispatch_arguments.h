// The group counts of indirect dispatches, computed on the device from its counters. On a CPU one more dispatch costs
// as much as the work of a small one, so the counts that depend on the same counters are computed together, before the
// first of their dispatches. These are known in advance because every sequence is recorded twice: the first time is a
// plan.
#pragma once

#include <cstdint>
#include <vector>

#include "device_commands/memory.h"
#include "device_commands/recorder.h"
#include "device_commands/stop_word.h"
#include "gpu_types.h"

namespace medial_vk {

class DispatchArguments {
 public:
  /// Creates the buffers. `counters` are the pipeline's; `stop` outlives this. `is_stage`: the recorder's clock
  /// measures this work as a stage of its own. Errors: kOutOfMemory.
  Status create(Arena& arena, const Buffer& counters, const StopWord& stop, bool is_stage);

  /// Starts the plan: offset_of() only notes requests, and nothing may be dispatched.
  void begin_plan();
  /// Starts the recording: the same calls must follow in the same order as after begin_plan().
  void begin();
  bool plans() const { return plans_; }

  /// Counters have changed, or the host may stop a run here: later group counts are prepared after this point.
  void counters_change() { is_stale_ = true; }
  /// A change of counters between levels (kStart* in gpu_types.h), made together with the next preparation.
  void start(Recorder& recorder, std::uint32_t start);
  /// The offset in buffer() of the group counts for `wanted` (without its `argument`).
  VkDeviceSize offset_of(Recorder& recorder, const gpu::DispatchConstants& wanted);

  const Buffer& buffer() const { return arguments_; }

 private:
  // Dispatches that are prepared together, after the change `start`.
  struct Batch {
    std::uint32_t start = gpu::kStartNothing;
    std::vector<gpu::DispatchConstants> rows;
  };
  // The result of a call of offset_of().
  struct Call {
    std::size_t batch, row;
  };

  void note(const gpu::DispatchConstants& wanted);
  void record_batch(Recorder& recorder);

  Buffer counters_, table_, arguments_;
  const StopWord* stop_ = nullptr;
  std::vector<Batch> batches_;
  std::vector<Call> calls_;
  std::size_t next_batch_ = 0, next_call_ = 0;
  std::uint32_t next_row_ = 0;  // of the table; its rows are those of the arguments
  bool is_stage_ = false, plans_ = false, is_stale_ = true;
};

}  // namespace medial_vk
