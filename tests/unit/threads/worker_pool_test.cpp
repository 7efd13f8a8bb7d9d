// Loops on threads that are kept: every item once, whatever was before, and an exception of a body ends only its loop.
#include "threads/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <set>
#include <thread>
#include <vector>

namespace medial_vk {
namespace {

TEST(WorkerPool, EveryItemOnceInEveryLoop) {
  for (const unsigned threads : {0u, 1u, 3u, 40u}) {
    WorkerPool pool(threads);
    for (int repeat = 0; repeat < 50; ++repeat) {
      for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
        for (const std::size_t block : {1u, 3u, 64u, 5000u}) {
          std::vector<std::atomic<int>> calls(count);
          pool.run(count, block, [&](std::size_t i) { ++calls[i]; });
          for (const std::atomic<int>& n : calls) ASSERT_EQ(n, 1);
        }
      }
    }
  }
}

// What a body keeps for its worker is used by one thread at a time.
TEST(WorkerPool, NoTwoCallsAtATimeHaveOneWorker) {
  WorkerPool pool(4);
  EXPECT_LE(pool.threads(), 4u);
  std::vector<std::atomic<int>> running(pool.threads());
  std::atomic<int> done = 0;
  pool.run(2000, 1, [&](std::size_t, unsigned worker) {
    ASSERT_LT(worker, running.size());
    EXPECT_EQ(running[worker].fetch_add(1), 0);
    --running[worker];
    ++done;
  });
  EXPECT_EQ(done, 2000);
}

TEST(WorkerPool, ALoopAfterOneThatThrew) {
  WorkerPool pool(3);
  std::atomic<int> running = 0, done = 0;
  const auto body = [&](std::size_t i) {
    ++running;
    const bool fails = i == 17;
    --running;
    if (fails) throw std::bad_alloc();
    ++done;
  };
  EXPECT_THROW(pool.run(100'000, 1, body), std::bad_alloc);
  EXPECT_EQ(running, 0);
  EXPECT_LT(done, 100'000);
  done = 0;
  pool.run(1000, 1, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 1000);
}

TEST(WorkerPool, OneThreadIsTheCallers) {
  WorkerPool pool(1);
  std::vector<std::thread::id> by(1000);
  pool.run(by.size(), 1, [&](std::size_t i) { by[i] = std::this_thread::get_id(); });
  for (const std::thread::id& id : by) EXPECT_EQ(id, std::this_thread::get_id());
}

// Each item waits until another thread has one, too, so no single thread can do all of them.
TEST(WorkerPool, SeveralThreadsTakePartAndNoMoreThanWanted) {
  WorkerPool pool(3);
  for (int repeat = 0; repeat < 3; ++repeat) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const auto number_seen = [&] {
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
      return seen.size();
    };
    pool.run(2, 1, [&](std::size_t) {
      while (number_seen() < 2) std::this_thread::sleep_for(std::chrono::microseconds(50));
    });
    pool.run(2000, 1, [&](std::size_t) { number_seen(); });
    EXPECT_GE(seen.size(), 2u);
    EXPECT_LE(seen.size(), 3u);
  }
}

}  // namespace
}  // namespace medial_vk
