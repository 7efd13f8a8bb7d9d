#include "cli/extract/device_opening.h"

#include <memory>
#include <utility>

#include "base/host_threads.h"
#include "base/stopwatch.h"
#include "cli/terminal/messages.h"

namespace medial_vk::cli {

void DeviceOpening::start(const std::string& wanted) {
  wanted_ = wanted;
  ContextOptions options;
  options.device = wanted;
  auto loading = std::make_shared<LoadingLibraries>();
  // Without a thread to be had: when it is asked for.
  opening_ = std::async(std::launch::async | std::launch::deferred, [options, loading = std::move(loading)]() mutable {
    Result<Context> opened = Context::create(options);
    loading.reset();
    return opened;
  });
}

Status DeviceOpening::take(std::optional<Context>& context, std::optional<DeviceDescription>& description,
                           std::vector<StageTime>& times) {
  if (!opening_.valid()) return {};
  Stopwatch stopwatch;
  Result<Context> opened = opening_.get();
  if (!opened) return with_hint(opened.error(), wanted_);
  context.emplace(std::move(opened).value());
  description = context->device();
  times.push_back({"device", stopwatch.lap()});
  return {};
}

}  // namespace medial_vk::cli
