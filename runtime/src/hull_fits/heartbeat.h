// Progress that goes on while nothing new is known.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "medial_vk/progress.h"

namespace medial_vk {

/// Reports what was told last again and again: a caller may only hear of a request to stop where its callback is
/// called. Works from a thread of its own; without one, if none can be created, only what is told is reported.
class Heartbeat {
 public:
  explicit Heartbeat(StageProgress progress) : progress_(std::move(progress)) {
    if (!progress_) return;
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {
      // As the class says.
    }
  }
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  ~Heartbeat() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
    }
    ends_.notify_one();
    thread_.join();
  }

  /// Reports a stage and its share at once. `stage` must outlive this object.
  void tell(const char* stage, double done) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    done_ = done;
    if (progress_) progress_(stage_, done_);
  }

 private:
  void run() {
    constexpr std::chrono::milliseconds kPeriod(50);
    std::unique_lock lock(mutex_);
    while (!ends_.wait_for(lock, kPeriod, [this] { return is_ending_; })) {
      if (stage_ != nullptr) progress_(stage_, done_);
    }
  }

  const StageProgress progress_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool is_ending_ = false;
  const char* stage_ = nullptr;
  double done_ = 0;
  std::thread thread_;
};

}  // namespace medial_vk
