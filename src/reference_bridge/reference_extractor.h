// The CPU reference as a backend: `--backend cpu`.
#pragma once

#include "medial_vk/extraction.h"

namespace medial_vk {

/// Runs in double precision, on one thread, without Vulkan.
Extractor reference_extractor();

}  // namespace medial_vk
