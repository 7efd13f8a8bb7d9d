// How many threads of the host a loop should use just now.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace medial_vk {

/// While one lives, some thread loads a driver with its libraries. glibc then holds a lock that everybody needs who
/// starts a thread, until all is relocated (25 ms for LLVM): a loop is done sooner by the thread that is there. What
/// else opening a device takes is no reason to wait.
class LoadingLibraries {
 public:
  LoadingLibraries() {
    latest_ = (Clock::now() + std::chrono::milliseconds(50)).time_since_epoch().count();
    ++number_;
  }
  ~LoadingLibraries() { --number_; }
  LoadingLibraries(const LoadingLibraries&) = delete;
  LoadingLibraries& operator=(const LoadingLibraries&) = delete;

  static bool any() { return number_ != 0 && Clock::now().time_since_epoch().count() < latest_; }

 private:
  using Clock = std::chrono::steady_clock;
  inline static std::atomic<int> number_ = 0;
  inline static std::atomic<Clock::rep> latest_ = 0;
};

/// At least 1; `wanted` 0: as many as the machine has.
inline unsigned host_threads(unsigned wanted = 0) {
  if (LoadingLibraries::any()) return 1;
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace medial_vk
