// Callbacks that report the progress of long calls.
#pragma once

#include <functional>

namespace medial_vk {

/// Called with the finished share, 0 to 1: between the steps of the work, and every ten milliseconds while the device
/// computes.
using ProgressCallback = std::function<void(double done)>;
/// The same for calls with several stages; their descriptions list the names of the stages.
using StageProgress = std::function<void(const char* stage, double done)>;

}  // namespace medial_vk
