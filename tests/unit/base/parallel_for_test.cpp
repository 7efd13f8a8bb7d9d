// Loops on several threads: every item once, on the requested number of threads, and an exception of a body ends them
// in order.
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace medial_vk {
namespace {

TEST(ParallelFor, EveryItemOnce) {
  for (const unsigned threads : {0u, 1u, 3u, 40u}) {
    for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
      for (const std::size_t block : {1u, 3u, 64u, 5000u}) {
        std::vector<std::atomic<int>> calls(count);
        parallel_for(count, block, threads, [&](std::size_t i) { ++calls[i]; });
        for (const std::atomic<int>& n : calls) EXPECT_EQ(n, 1);
      }
    }
  }
}

TEST(ParallelFor, PassesOnWhatABodyThrowsOnceAllThreadsHaveEnded) {
  std::atomic<int> running = 0, done = 0;
  const auto body = [&](std::size_t i) {
    ++running;
    const bool fails = i == 17;
    --running;
    if (fails) throw std::bad_alloc();
    ++done;
  };
  EXPECT_THROW(parallel_for(100'000, 1, 0, body), std::bad_alloc);
  EXPECT_EQ(running, 0);
  EXPECT_LT(done, 100'000);
}

TEST(ParallelFor, OneThreadIsTheCallers) {
  std::vector<std::thread::id> by(1000);
  parallel_for(by.size(), 1, 1, [&](std::size_t i) { by[i] = std::this_thread::get_id(); });
  for (const std::thread::id& id : by) EXPECT_EQ(id, std::this_thread::get_id());
}

TEST(ParallelFor, NoMoreThreadsThanWanted) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallel_for(2000, 1, 3, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_LE(seen.size(), 3u);
  EXPECT_GE(seen.size(), 1u);
}

}  // namespace
}  // namespace medial_vk
