#include "cli/device_opening.h"

#include "cli/messages.h"

namespace medial_vk::cli {

void DeviceOpening::start(const std::string& wanted) {
  wanted_ = wanted;
  ContextOptions options;
  options.device = wanted;
  // Without a thread to be had: when it is asked for.
  opening_ = std::async(std::launch::async | std::launch::deferred, [options] { return Context::create(options); });
}

Result<Context> DeviceOpening::take() {
  Result<Context> context = opening_.get();
  if (!context) return with_hint(context.error(), wanted_);
  return context;
}

}  // namespace medial_vk::cli
