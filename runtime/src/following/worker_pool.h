// Threads of the host that are kept from one loop to the next.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace medial_vk {

/// For loops in every frame of a motion: creating threads takes longer than a short loop, and allocates. Used by one
/// thread at a time, and not from within its own loops.
class WorkerPool {
 public:
  /// `threads` of them, with the caller's (0: one per core); fewer where no more can be created. Throws std::bad_alloc.
  explicit WorkerPool(unsigned threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls body(i) for every i in [0, count), as parallel_for() does. Allocates nothing.
  template <class Body>
  void run(std::size_t count, std::size_t block, const Body& body) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr thrown;
    const auto work = [&]() noexcept {
      try {
        for (std::size_t begin = next.fetch_add(block); begin < count; begin = next.fetch_add(block)) {
          for (std::size_t i = begin; i < std::min(begin + block, count); ++i) body(i);
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        thrown = std::current_exception();
        next = count;  // skips the remaining blocks
      }
    };
    const auto call = [](const void* context) noexcept { (*static_cast<const decltype(work)*>(context))(); };
    run_on((count + block - 1) / block, {call, &work});
    if (thrown) std::rethrow_exception(thrown);
  }

 private:
  struct Task {
    void (*call)(const void* context) noexcept = nullptr;
    const void* context = nullptr;
  };

  /// On the caller's thread and up to `blocks` - 1 others; returns once all of them have ended.
  void run_on(std::size_t blocks, const Task& task);
  void serve() noexcept;

  std::mutex mutex_;
  std::condition_variable has_begun_, has_ended_;
  Task task_;
  std::size_t wanted_ = 0;   // workers that shall still take the task
  std::size_t running_ = 0;  // workers that have taken it or shall
  bool is_ending_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace medial_vk
