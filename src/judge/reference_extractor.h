// The CPU reference as a way to find medial spheres: `--backend cpu`.
#pragma once

#include "medial_vk/extraction.h"

namespace medial_vk {

/// In double precision, on one thread, without Vulkan.
Extractor reference_extractor();

}  // namespace medial_vk
