// Loops over all cores: everything once, and what a body throws ends them in order.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace medial_vk {
namespace {

TEST(ParallelFor, EveryItemOnce) {
  for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
    for (const std::size_t block : {1u, 3u, 64u, 5000u}) {
      std::vector<std::atomic<int>> calls(count);
      parallel_for(count, block, [&](std::size_t i) { ++calls[i]; });
      for (const std::atomic<int>& n : calls) EXPECT_EQ(n, 1);
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
  EXPECT_THROW(parallel_for(100'000, 1, body), std::bad_alloc);
  EXPECT_EQ(running, 0);
  EXPECT_LT(done, 100'000);
}

TEST(ParallelFor, StartsNoThreadWhileLibrariesAreLoaded) {
  const unsigned all = host_threads();
  {
    const LoadingLibraries one;
    const LoadingLibraries another;
    EXPECT_EQ(host_threads(), 1u);
    EXPECT_EQ(host_threads(8), 1u);
    std::vector<std::thread::id> by(1000);
    parallel_for(by.size(), 1, [&](std::size_t i) { by[i] = std::this_thread::get_id(); });
    for (const std::thread::id& id : by) EXPECT_EQ(id, std::this_thread::get_id());
  }
  EXPECT_EQ(host_threads(), all);
  EXPECT_EQ(host_threads(8), 8u);
}

TEST(ParallelFor, DoesNotWaitForDevicesThatTakeLongToOpen) {
  const LoadingLibraries one;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_FALSE(LoadingLibraries::any());
}

}  // namespace
}  // namespace medial_vk
