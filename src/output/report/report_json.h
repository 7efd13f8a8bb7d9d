// The report of a run as JSON. Every key is described in docs/report.md; keys are added, never renamed.
#pragma once

#include <string>

#include "output/report/run_record.h"

namespace medial_vk {

/// Indented by two, ending in a newline. Text that is not UTF-8 (a file name) is replaced, not an error.
std::string report_json(const RunRecord& record);

}  // namespace medial_vk
