// The Vulkan device is opened while something else is done.
#pragma once

#include <chrono>
#include <cstddef>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/extraction.h"

namespace medial_vk::cli {

class DeviceOpening {
 public:
  /// Begins, on a thread of its own. `wanted` is what --device named, or empty: the best.
  void start(const std::string& wanted, unsigned threads);
  /// How many threads work on a mesh should use that is done meanwhile. While a driver is loaded, glibc holds a lock
  /// that every new thread needs, until all libraries are relocated (25 ms for LLVM): work that takes less is done
  /// sooner by the thread that is there.
  unsigned threads_beside(std::size_t triangles, unsigned wanted) const;
  /// Waits for it: the context, what it is, and a line "device" with the time that was spent here. Without start(),
  /// nothing. Errors: those of Context::create(), with what to do about them.
  Status take(std::optional<Context>& context, std::optional<DeviceDescription>& description,
              std::vector<StageTime>& times);

 private:
  std::string wanted_;
  std::future<Result<Context>> opening_;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace medial_vk::cli
