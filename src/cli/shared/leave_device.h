// The end of a process that has used a device.
#pragma once

#include <optional>

#include "medial_vk/context.h"

namespace medial_vk::cli {

/// Call it once, when all work is done and the process ends: the operating system releases the device sooner than its
/// driver would. Without a context it does nothing.
void leave_device(std::optional<Context>& context);

}  // namespace medial_vk::cli
