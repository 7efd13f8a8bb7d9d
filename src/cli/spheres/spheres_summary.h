// Terminal messages of `medial-vk spheres`.
#pragma once

#include <span>
#include <string>

#include "check_reports/check_report.h"
#include "cli/options/spheres_options.h"
#include "output/atomic_files/atomic_file.h"
#include "output/fit_reports/fits_record.h"

namespace medial_vk::cli {

/// The checks of all parts, joined to one line per condition; `first_failure` names the link.
CheckReport joint_check(const FitsRecord& record);

/// One line before the work begins: the input and the device.
std::string spheres_opening(const SpheresOptions& options, const FitsRecord& record);
/// A few lines at the end, after `files` have been written.
std::string spheres_summary(const SpheresOptions& options, const FitsRecord& record, std::span<const OutputFile> files);
/// For -v: one line per part.
std::string spheres_details(const SpheresOptions& options, const FitsRecord& record);

}  // namespace medial_vk::cli
