#pragma once

#include "medial_vk/extraction.h"

namespace medial_vk {

/// `extractor` for a single mesh: the extraction for given options runs once and is returned again. A part whose balls
/// are distributed by need is fitted twice, for its curve and for its spheres, and both start from the same medial
/// spheres. For one thread at a time. Throws std::bad_alloc, as do calls of the result.
Extractor kept_extractions(Extractor extractor);

}  // namespace medial_vk
