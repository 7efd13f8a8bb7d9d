// How many threads of the host a loop should use just now.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>

namespace medial_vk {

/// While one lives, some thread loads a driver with its libraries. glibc then holds a lock that everybody needs who
/// starts a thread, until all is relocated (25 ms for LLVM): a loop is done sooner by the thread that is there.
class LoadingLibraries {
 public:
  LoadingLibraries() { ++number_; }
  ~LoadingLibraries() { --number_; }
  LoadingLibraries(const LoadingLibraries&) = delete;
  LoadingLibraries& operator=(const LoadingLibraries&) = delete;

  static bool any() { return number_ != 0; }

 private:
  inline static std::atomic<int> number_ = 0;
};

/// At least 1; `wanted` 0: as many as the machine has.
inline unsigned host_threads(unsigned wanted = 0) {
  if (LoadingLibraries::any()) return 1;
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace medial_vk
