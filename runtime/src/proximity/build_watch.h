// The progress of the build of a tree, and its early end.
#pragma once

#include <mutex>
#include <stop_token>

#include "medial_vk/progress.h"

namespace medial_vk {

/// Thrown by a build that is stopped.
struct BuildStopped {};

/// For loops on several threads: every call may come from any of them. Keeps references to both arguments.
class BuildWatch {
 public:
  BuildWatch(const ProgressCallback& progress, const std::stop_token& stop) : progress_(progress), stop_(stop) {}

  /// Throws BuildStopped if a stop was requested.
  void check() const {
    if (stop_.stop_requested()) throw BuildStopped();
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
