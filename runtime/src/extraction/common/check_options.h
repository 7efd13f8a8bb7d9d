// The check of the options of an extraction, before any other work.
#pragma once

#include "medial_vk/medial_spheres.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Error: kUsage, which names the parameter and its range.
Status check_options(const ExtractionOptions& options);

}  // namespace medial_vk
