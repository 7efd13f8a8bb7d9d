// Opens the Vulkan device while other work runs.
#pragma once

#include <chrono>
#include <cstddef>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "cli/shared/programs_watch.h"
#include "cli/terminal/progress.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"

namespace medial_vk::cli {

class DeviceOpening {
 public:
  /// Opens the device on a thread of its own; with `threads` 1, in take(). `device` is the argument of --device, or
  /// empty for the best device. `progress` shows the programs that the driver compiles.
  void start(const std::string& device, unsigned threads, Progress& progress);
  /// The number of threads for work on a mesh while the device is opened. While a driver is loaded, glibc holds a lock
  /// that every new thread needs, until all libraries are relocated (25 ms for LLVM): shorter work finishes sooner on
  /// the existing thread.
  unsigned threads_beside(std::size_t triangles, unsigned requested) const;
  /// Waits until the device is open. The results are the context, its description, and a line "device" with the time
  /// that this call waited. Without start(), it does nothing. Errors: those of Context::create(), with a remedy.
  Status take(std::optional<Context>& context, std::optional<DeviceDescription>& description,
              std::vector<StageTime>& times);

 private:
  ProgramsWatch programs_;
  std::string device_name_;
  std::future<Result<Context>> opening_;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace medial_vk::cli
