// A word that the device looks at whenever it sizes dispatches of a recorded sequence: once the host raises it, those
// that are left are empty (prepare.glsl). So a job stops within the few dispatches that are sized together
// (dispatch_arguments.h), without round trips while it runs.
//
// Host-coherent memory needs no flush, but Vulkan promises nothing about when a dispatch sees what the host writes
// after the submission. Drivers show it at the next barrier; if one did not, the job would stop later, at the next
// chunk.
#pragma once

#include <optional>

#include "commands/memory.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

class StopWord {
 public:
  /// Errors: kOutOfMemory.
  static Result<StopWord> create(Context::Impl& context);

  BufferRange range() const { return word_.range(); }
  void raise();

 private:
  explicit StopWord(Context::Impl& context) : arena_(context) {}

  Arena arena_;
  Buffer word_;
};

/// Reports progress, and checks between parts of the work and while the device is busy whether the job is to stop.
class StopWatch {
 public:
  StopWatch(const ProgressCallback& progress, const std::stop_token& stop) : progress_(progress), stop_(stop) {}

  /// The word that is raised from now on. It lives as long as the watch. Errors: kOutOfMemory.
  Result<const StopWord*> make_word(Context::Impl& context);
  /// Share of the job that is done: what the callback is told.
  void set_done(double done) { done_ = done; }
  /// Reports and checks. True from the first time on that a stop has been requested.
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
