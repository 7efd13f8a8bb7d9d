// The summary of `medial-vk clearance`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/clearance/robot_and_scene.h"
#include "cli/options/clearance_options.h"
#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_files/clearances_csv.h"

namespace medial_vk::cli {

/// What was read, and what is compared.
std::string clearance_opening(const ClearanceOptions& options, const RobotAndScene& all, std::size_t joints);

/// `beyond` is the number of configurations in which a joint is beyond its limits. `times` has one of "distances".
/// Precondition: there is a clearance.
std::string clearance_summary(const ClearanceOptions& options, std::span<const Clearance> clearances,
                              std::size_t beyond, const std::vector<StageTime>& times,
                              std::span<const OutputFile> files);

}  // namespace medial_vk::cli
