// The device, the progress and the threads that the meshes of one run share.
#pragma once

#include <optional>
#include <vector>

#include "cli/shared/device_opening.h"
#include "cli/terminal/progress.h"
#include "medial_vk/context.h"

namespace medial_vk::cli {

/// What all meshes of a run share.
struct SharedOfRun {
  explicit SharedOfRun(bool shows_progress) : progress(shows_progress) {}

  Progress progress;
  DeviceOpening opening;
  std::optional<Context> context;
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Of the steps that all meshes share.
};

}  // namespace medial_vk::cli
