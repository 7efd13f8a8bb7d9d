// The report of a run as JSON. Every key is described in docs/report.md; keys are added, never renamed.
#pragma once

#include <string>

#include "output/extraction_report/run_record.h"

namespace medial_vk {

/// Indented by two, with a final newline. Text that is not UTF-8 (a file name) is replaced and causes no error.
std::string report_json(const RunRecord& record);

}  // namespace medial_vk
