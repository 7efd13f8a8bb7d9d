#include "cli/shared/reference_with_estimate.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"

namespace medial_vk::cli {

std::string estimate_line(const TimeEstimate& estimate) {
  constexpr double kWorthALine = 10;
  if (estimate.seconds < kWorthALine) return {};
  const double unit = std::pow(10, std::floor(std::log10(estimate.seconds)) - 1);
  const std::string time = duration(std::round(estimate.seconds / unit) * unit);
  const auto voxels = static_cast<std::uint64_t>(estimate.voxels);
  return fmt::format("  estimate  about {}{} on one thread, from {} chosen at random; a device is faster\n", time,
                     estimate.is_cut_off ? ", or much more," : "", counted(voxels, "voxel", "voxels"));
}

Extractor reference_with_estimate(Progress& progress) {
  if (!progress.is_requested()) return reference_extractor();
  return reference_extractor([&progress](const TimeEstimate& estimate) {
    const std::string text = estimate_line(estimate);
    if (text.empty()) return;
    progress.clear();
    print_message(text);
  });
}

}  // namespace medial_vk::cli
