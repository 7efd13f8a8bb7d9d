// Threads of the host that are kept from one loop to the next.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
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

  /// With the caller's.
  unsigned threads() const { return static_cast<unsigned>(workers_.size()) + 1; }
  /// Calls body(i), or body(i, worker), for every i in [0, count), as parallel_for() does. Calls at the same time have
  /// different workers, numbers below threads(). Allocates nothing.
  template <class Body>
  void run(std::size_t count, std::size_t block, const Body& body) {
    LoopOf<Body> loop(count, block, body);
    run((count + block - 1) / block, loop);
    loop.rethrow();
  }

 private:
  /// A loop whose blocks several threads take.
  class Loop {
   public:
    virtual ~Loop() = default;
    virtual void take_part(unsigned worker) noexcept = 0;
  };

  template <class Body>
  class LoopOf final : public Loop {
   public:
    LoopOf(std::size_t count, std::size_t block, const Body& body) : count_(count), block_(block), body_(body) {}

    void take_part(unsigned worker) noexcept override {
      try {
        for (std::size_t begin = next_.fetch_add(block_); begin < count_; begin = next_.fetch_add(block_)) {
          for (std::size_t i = begin; i < std::min(begin + block_, count_); ++i) call(i, worker);
        }
      } catch (...) {
        const std::lock_guard lock(mutex_);
        thrown_ = std::current_exception();
        next_ = count_;  // skips the remaining blocks
      }
    }

    void rethrow() const {
      if (thrown_) std::rethrow_exception(thrown_);
    }

   private:
    void call(std::size_t i, unsigned worker) const {
      if constexpr (std::is_invocable_v<const Body&, std::size_t, unsigned>) {
        body_(i, worker);
      } else {
        body_(i);
      }
    }

    const std::size_t count_, block_;
    const Body& body_;
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr thrown_;
  };

  /// On the caller's thread and up to `blocks` - 1 others; returns once all of them have ended.
  void run(std::size_t blocks, Loop& loop);
  void serve(unsigned worker) noexcept;

  std::mutex mutex_;
  std::condition_variable has_begun_, has_ended_;
  Loop* loop_ = nullptr;
  std::size_t wanted_ = 0;   // workers that shall still take part in the loop
  std::size_t running_ = 0;  // workers that do or shall
  bool is_ending_ = false;
  std::vector<std::thread> workers_;
};

/// After a loop whose workers each have an object with memory of its own: grow(object, of) gives each one what another
/// has, so that the next loop allocates nothing for the same work, whichever worker does it.
template <class Objects, class Grow>
void share_room(Objects& by_worker, const Grow& grow) {
  for (std::size_t i = 1; i < by_worker.size(); ++i) grow(*by_worker[0], *by_worker[i]);
  for (std::size_t i = 1; i < by_worker.size(); ++i) grow(*by_worker[i], *by_worker[0]);
}

}  // namespace medial_vk
