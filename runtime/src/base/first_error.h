// The error to return from work on numbered items by several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <utility>

#include "medial_vk/result.h"

namespace medial_vk {

/// The error of the first item, by number, that failed, so that the result does not depend on the order of the work.
class FirstError {
 public:
  /// From any thread.
  void add(std::size_t number, Status status) {
    if (status) return;
    const std::lock_guard lock(mutex_);
    if (number >= number_) return;
    number_ = number;
    status_ = std::move(status);
  }

  /// Whether an error of item `number` would be the one to return. From any thread.
  bool concerns(std::size_t number) const { return number < number_; }

  /// Not while add() may be called.
  const Status& status() const { return status_; }

 private:
  std::mutex mutex_;
  std::atomic<std::size_t> number_ = ~std::size_t{0};
  Status status_;
};

}  // namespace medial_vk
