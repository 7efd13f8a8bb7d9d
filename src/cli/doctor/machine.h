// The machine around Vulkan: its system, graphics cards, device files, a container; and the folder of the cache.
#pragma once

#include <string>

#include "cli/doctor/driver_search.h"
#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// `root`: the folder in the place of "/", for tests.
MachineRecord examine_machine(const Environment& environment, const std::string& root = "");

/// Tries to write a file to the folder, which is created if necessary, as a run does.
CacheRecord examine_cache(const std::string& folder);

}  // namespace medial_vk::cli
