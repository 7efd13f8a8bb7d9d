#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <vector>

#include "medial_vk/progress.h"

namespace medial_vk {

/// The finished share of the work on parts, several of which may be worked on at a time. The functions may be called
/// from any thread; the callback is called by one thread at a time.
class PartsProgress {
 public:
  PartsProgress(const StageProgress& callback, std::size_t parts) : callback_(callback), shares_(parts, 0) {}

  void expect(std::size_t steps) {
    const std::lock_guard lock(mutex_);
    steps_ += steps;
  }

  /// `part` is an index; `done` is the finished share of its present step.
  void report(std::size_t part, const char* stage, double done) {
    const std::lock_guard lock(mutex_);
    sum_ += done - shares_[part];
    shares_[part] = done;
    // A step may begin again, and further steps may be expected: the reported share never falls.
    greatest_ = std::clamp(sum_ / static_cast<double>(std::max<std::size_t>(1, steps_)), greatest_, 1.0);
    if (callback_) callback_(stage, greatest_);
  }

  /// Ends the present step of `part`.
  void finish(std::size_t part) {
    const std::lock_guard lock(mutex_);
    sum_ += 1 - shares_[part];
    shares_[part] = 0;
  }

 private:
  const StageProgress& callback_;
  std::mutex mutex_;
  std::size_t steps_ = 0;  // an approximation: curves may have to be continued
  double sum_ = 0;         // of finished steps and of shares_
  double greatest_ = 0;    // share reported so far
  std::vector<double> shares_;
};

}  // namespace medial_vk
