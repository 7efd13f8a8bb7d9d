// What `medial-vk spheres` says at the terminal.
#pragma once

#include <span>
#include <string>

#include "checks/check_report.h"
#include "cli/options/spheres_options.h"
#include "output/files/atomic_file.h"
#include "output/fits/fits_record.h"

namespace medial_vk::cli {

/// Of all parts, one line for each condition; `first_failure` names the link.
CheckReport joint_check(const FitsRecord& record);

/// One line before the work: what was read, where it runs.
std::string spheres_opening(const SpheresOptions& options, const FitsRecord& record);
/// A few lines at the end; `files` have been written.
std::string spheres_summary(const SpheresOptions& options, const FitsRecord& record, std::span<const OutputFile> files);
/// For -v: a line for each part.
std::string spheres_details(const SpheresOptions& options, const FitsRecord& record);

}  // namespace medial_vk::cli
