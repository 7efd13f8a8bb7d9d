// The progress of loops on several threads, and their early end.
#pragma once

#include <mutex>
#include <stop_token>

#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Thrown by a loop that is stopped.
struct LoopStopped {
  /// What the public call returns then.
  static Error error() { return {ErrorCode::kInterrupted, "interrupted"}; }
};

/// Every call may come from any thread. Keeps references to both arguments.
class LoopWatch {
 public:
  LoopWatch(const ProgressCallback& progress, const std::stop_token& stop) : progress_(progress), stop_(stop) {}

  /// Throws LoopStopped if a stop was requested.
  void check() const {
    if (stop_.stop_requested()) throw LoopStopped();
  }

  /// So many of `all` steps more are finished.
  void finish(std::size_t steps, std::size_t all) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    finished_ += steps;
    progress_(static_cast<double>(finished_) / static_cast<double>(all));
  }

 private:
  const ProgressCallback& progress_;
  const std::stop_token& stop_;
  std::mutex mutex_;
  std::size_t finished_ = 0;
};

}  // namespace medial_vk
