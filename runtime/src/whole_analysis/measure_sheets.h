// The steps of an analysis that concern the union of the balls: significance of sheets, and their removal.
#pragma once

#include <stop_token>

#include "medial_vk/analysis.h"

namespace medial_vk {

/// Fills in the significance, the orders of removal that are requested, and the removal itself: spheres of sheets that
/// are not kept leave `analysis`. Sheets keep their numbers. Errors: kInterrupted, kOutOfMemory.
Status measure_sheets(const AnalysisOptions& options, const StageProgress& progress, const std::stop_token& stop,
                      Analysis& analysis);

}  // namespace medial_vk
