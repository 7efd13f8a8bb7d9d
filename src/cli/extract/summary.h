// Messages of a run to its user, on standard error.
#pragma once

#include <span>
#include <string>

#include "output/atomic_files/atomic_file.h"
#include "output/extraction_report/run_record.h"

namespace medial_vk::cli {

/// One line before the work begins: the input, the method and the device.
std::string opening(const RunRecord& record);
/// A few aligned lines at the end, after `files` have been written.
std::string summary(const RunRecord& record, std::span<const OutputFile> files);
/// For -v: levels, seconds by the clock of the device, and the options that are not in the summary.
std::string details(const RunRecord& record);

}  // namespace medial_vk::cli
