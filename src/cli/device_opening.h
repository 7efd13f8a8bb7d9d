// The Vulkan device is opened while something else is done.
#pragma once

#include <future>
#include <string>

#include "medial_vk/context.h"

namespace medial_vk::cli {

class DeviceOpening {
 public:
  /// Begins, on a thread of its own. `wanted` is what --device named, or empty: the best.
  void start(const std::string& wanted);
  /// Waits for it; call once after start(). Errors: those of Context::create(), with what to do about them.
  Result<Context> take();

 private:
  std::string wanted_;
  std::future<Result<Context>> opening_;
};

}  // namespace medial_vk::cli
