#include "cli/shared/device_opening.h"

#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/messages.h"

namespace medial_vk::cli {

void DeviceOpening::start(const std::string& device, unsigned threads, Progress& progress) {
  device_name_ = device;
  ContextOptions options;
  options.device = device;
  options.threads = threads;
  options.programs_progress = [this, &progress](std::size_t made, std::size_t total) {
    programs_.update(made, total, progress);
  };
  started_ = std::chrono::steady_clock::now();
  // On one thread, or if no other is available, it runs when the context is taken.
  const std::launch policy = threads == 1 ? std::launch::deferred : std::launch::async | std::launch::deferred;
  opening_ = std::async(policy, [options] { return Context::create(options); });
}

unsigned DeviceOpening::threads_beside(std::size_t triangles, unsigned requested) const {
  constexpr std::chrono::milliseconds kLoading(50);
  constexpr std::size_t kQuick = 50'000;  // prepared or indexed by one thread in about the time of loading
  const bool is_loading = opening_.valid() && std::chrono::steady_clock::now() < started_ + kLoading;
  return is_loading && triangles < kQuick ? 1 : requested;
}

Status DeviceOpening::take(std::optional<Context>& context, std::optional<DeviceDescription>& description,
                           std::vector<StageTime>& times) {
  if (!opening_.valid()) return {};
  Stopwatch stopwatch;
  Result<Context> opened = opening_.get();
  if (!opened) return with_hint(opened.error(), device_name_);
  context.emplace(std::move(opened).value());
  description = context->device();
  programs_.set_device(description->name);
  times.push_back({"device", stopwatch.lap()});
  return {};
}

}  // namespace medial_vk::cli
