// The steps of an analysis that concern the union of the balls: significance of sheets, and their removal.
#pragma once

#include <stop_token>

#include "medial_vk/analysis.h"

namespace medial_vk {

/// Fills in the significance, the requested orders of removal, and the removal itself: the spheres of removed sheets
/// are deleted from `analysis`. Sheets keep their numbers. Errors: kInterrupted, kOutOfMemory.
Status measure_sheets(const AnalysisOptions& options, const StageProgress& progress, const std::stop_token& stop,
                      Analysis& analysis);

}  // namespace medial_vk
