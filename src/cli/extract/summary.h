// What a run tells its user, on standard error.
#pragma once

#include <span>
#include <string>

#include "output/files/atomic_file.h"
#include "output/report/run_record.h"

namespace medial_vk::cli {

/// One line before the work starts: what was read, what will run where.
std::string opening(const RunRecord& record);
/// A few aligned lines at the end; `files` have been written.
std::string summary(const RunRecord& record, std::span<const OutputFile> files);
/// For -v: levels, seconds by the device's own clock, and the parameters that are not in the summary.
std::string details(const RunRecord& record);

}  // namespace medial_vk::cli
