// Loops over independent items on several threads of the host.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace medial_vk {

/// The number of threads for an argument of 0: one per core.
inline unsigned thread_count(unsigned threads) {
  return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls body(begin, end) for the blocks of `block` items that cover [0, count), on up to `threads` threads (0: one per
/// core), the caller's among them. Blocks do not depend on `threads`, and so neither do the results of independent
/// bodies. An exception of a body ends the loop early, and one such exception is thrown here once all threads have
/// ended.
template <class Body>
void parallel_blocks(std::size_t count, std::size_t block, unsigned threads, const Body& body) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&]() noexcept {
    try {
      for (std::size_t begin = next.fetch_add(block); begin < count; begin = next.fetch_add(block)) {
        body(begin, std::min(begin + block, count));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
      next = count;  // skips the remaining blocks
    }
  };
  const std::size_t useful = std::min<std::size_t>(thread_count(threads), (count + block - 1) / block);
  std::vector<std::thread> others;
  try {
    for (std::size_t i = 1; i < useful; ++i) others.emplace_back(work);
  } catch (const std::system_error&) {
    // No further thread can be created: those that exist do all of the work.
  } catch (const std::bad_alloc&) {
    // Likewise.
  }
  work();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

/// Calls body(i) for every i in [0, count), in blocks like those of parallel_blocks().
template <class Body>
void parallel_for(std::size_t count, std::size_t block, unsigned threads, const Body& body) {
  parallel_blocks(count, block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace medial_vk
