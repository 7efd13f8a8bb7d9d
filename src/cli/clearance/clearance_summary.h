// The summary of `medial-vk clearance`.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cli/clearance/fitted_links.h"
#include "cli/clearance/robot_and_scene.h"
#include "cli/options/clearance_options.h"
#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_files/clearances_csv.h"

namespace medial_vk::cli {

/// What was read, and what is compared.
std::string clearance_opening(const ClearanceOptions& options, const RobotAndScene& all, std::size_t joints);

/// How many balls there are, and with `--bodies` where they are from.
std::string balls_opening(const ClearanceOptions& options, const BallsOfSolids& balls);

/// Joints that are beyond their limits.
struct BeyondLimits {
  std::size_t configurations = 0;  ///< With such a joint.
  std::size_t first = 0;           ///< The first of them, from 1.
  std::string joint = {};          ///< The first such joint there.
  double position = 0, limit = 0;  ///< In radians or metres.
};

/// `values` has the positions of `joints` in each configuration.
BeyondLimits find_beyond_limits(std::span<const FreeJoint> joints, std::span<const std::vector<double>> values);

/// `by_triangles` is the number of clearances that triangles gave. `times` has one of "distances". Precondition: there
/// is a clearance.
std::string clearance_summary(const ClearanceOptions& options, std::span<const Clearance> clearances,
                              std::size_t by_triangles, const BeyondLimits& beyond, const std::vector<StageTime>& times,
                              std::span<const OutputFile> files);

}  // namespace medial_vk::cli
