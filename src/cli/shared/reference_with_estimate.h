// The CPU reference, which takes long on large meshes and says so before it starts.
#pragma once

#include <string>

#include "cli/terminal/progress.h"
#include "reference_bridge/reference_extractor.h"

namespace medial_vk::cli {

/// A line with the time that a search of the reference will take, or nothing if it is short.
std::string estimate_line(const TimeEstimate& estimate);

/// The reference; each of its searches begins with that line, where messages are requested. `progress` must outlive it.
Extractor reference_with_estimate(Progress& progress);

}  // namespace medial_vk::cli
