// A word that the device reads whenever it sizes dispatches of a recorded sequence: once the host has raised it, the
// remaining dispatches are empty (prepare.glsl). A job thus stops within the few dispatches that are sized together
// (dispatch_arguments.h), without round trips during its run.
//
// Host-coherent memory needs no flush, but Vulkan does not guarantee when a dispatch sees writes of the host after the
// submission. With current drivers this is the next barrier; otherwise the job would stop later, at the next chunk.
#pragma once

#include <optional>
#include <stop_token>

#include "device_commands/memory.h"
#include "medial_vk/progress.h"

namespace medial_vk {

class StopWord {
 public:
  /// Errors: kOutOfMemory.
  static Result<StopWord> create(ContextImpl& context);

  BufferRange range() const { return word_.range(); }
  void raise();

 private:
  explicit StopWord(ContextImpl& context) : arena_(context) {}

  Arena arena_;
  Buffer word_;
};

/// Reports progress, and checks between chunks and while the device is busy whether the job is to stop.
class StopWatch {
 public:
  StopWatch(const ProgressCallback& progress, const std::stop_token& stop) : progress_(progress), stop_(stop) {}

  /// The word to raise from now on. It lives as long as the watch. Errors: kOutOfMemory.
  Result<const StopWord*> make_word(ContextImpl& context);
  /// The finished share of the job, for the callback.
  void set_done(double done) { done_ = done; }
  /// Reports progress and checks. True from the first detection of a requested stop on.
  bool stopped();

  static Error error() { return {ErrorCode::kInterrupted, "interrupted during the extraction"}; }

 private:
  const ProgressCallback& progress_;
  std::stop_token stop_;
  std::optional<StopWord> word_;
  double done_ = 0;
  bool stopped_ = false;
};

}  // namespace medial_vk
