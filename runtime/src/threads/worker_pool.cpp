#include "threads/worker_pool.h"

#include <new>
#include <system_error>

#include "base/parallel.h"

namespace medial_vk {

WorkerPool::WorkerPool(unsigned threads) {
  const unsigned count = thread_count(threads);
  workers_.reserve(count - 1);
  try {
    for (unsigned i = 1; i < count; ++i) workers_.emplace_back([this, i] { serve(i); });
  } catch (const std::system_error&) {
    // No further thread can be created: those that exist do all of the work.
  } catch (const std::bad_alloc&) {
    // Likewise.
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  has_begun_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::run(std::size_t blocks, Loop& loop) {
  const std::size_t others = std::min(workers_.size(), std::max<std::size_t>(blocks, 1) - 1);
  if (others > 0) {
    const std::lock_guard lock(mutex_);
    loop_ = &loop;
    wanted_ = running_ = others;
  }
  for (std::size_t i = 0; i < others; ++i) has_begun_.notify_one();
  loop.take_part(0);
  if (others == 0) return;
  std::unique_lock lock(mutex_);
  // Workers that have not woken yet are not waited for: no block is left for them.
  running_ -= wanted_;
  wanted_ = 0;
  has_ended_.wait(lock, [&] { return running_ == 0; });
  loop_ = nullptr;
}

void WorkerPool::serve(unsigned worker) noexcept {
  std::unique_lock lock(mutex_);
  while (true) {
    has_begun_.wait(lock, [&] { return is_ending_ || wanted_ > 0; });
    if (is_ending_) return;
    --wanted_;
    Loop& loop = *loop_;
    lock.unlock();
    loop.take_part(worker);
    lock.lock();
    if (--running_ == 0) has_ended_.notify_one();
  }
}

}  // namespace medial_vk
