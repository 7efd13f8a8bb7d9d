// Parameters of an extraction, before any work is done for them.
#pragma once

#include "medial_vk/extraction.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Error: kUsage, which names the parameter and its range.
Status check_parameters(const ExtractionOptions& parameters);

}  // namespace medial_vk
