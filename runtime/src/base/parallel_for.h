// A loop over independent items on the cores that are at hand.
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

#include "base/host_threads.h"

namespace medial_vk {

/// Calls body(i) for i in [0, count), in blocks of `block`. The calls must not depend on each other; what they write
/// then does not depend on the number of cores either. What a call throws ends the loop early; one such exception is
/// thrown here once all threads have ended.
template <class Body>
void parallel_for(std::size_t count, std::size_t block, Body body) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&]() noexcept {
    try {
      for (std::size_t first = next.fetch_add(block); first < count; first = next.fetch_add(block)) {
        for (std::size_t i = first; i < std::min(first + block, count); ++i) body(i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
      next = count;  // the blocks that are left
    }
  };
  const std::size_t blocks = (count + block - 1) / block;
  const std::size_t threads = std::min<std::size_t>({host_threads(), blocks, 16});
  std::vector<std::thread> others;
  try {
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work);
  } catch (const std::system_error&) {
    // No more threads to be had: those there are do it all.
  } catch (const std::bad_alloc&) {
    // Likewise.
  }
  work();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace medial_vk
