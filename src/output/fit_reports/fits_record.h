// The data of one finished run of `medial-vk spheres`, for the summary and the report.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "common/backend.h"
#include "medial_vk/context.h"
#include "medial_vk/spheres.h"
#include "robots/fit_parts.h"

namespace medial_vk {

struct FitsRecord {
  // The request.
  std::string input;
  std::string output;
  std::string output_format;
  bool is_robot = false;
  SphereOptions request;
  std::size_t count_per_link = 0;  ///< 0: not given.
  std::size_t total = 0;           ///< 0: not given.
  Backend backend = Backend::kVulkan;

  std::string robot;                               ///< Name of the robot or mesh.
  std::vector<Part> parts;                         ///< The fitted parts ...
  std::vector<PartFit> fits;                       ///< ... and their fits, in the same order.
  std::vector<std::optional<CheckReport>> checks;  ///< The results of --check, in the same order; else empty.
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Seconds, in the order of the run.
};

/// The names used by the options and in the report.
const char* name_of(SphereContract contract);
const char* name_of(SphereMethod method);

/// The number of spheres of the last level of all parts.
std::size_t count_spheres(const FitsRecord& record);
/// The share of the volume that balls inside leave uncovered; none if a mesh encloses no volume, or for other
/// contracts.
std::optional<double> uncovered_share(const PartFit& fit, SphereContract contract);
std::optional<double> uncovered_share(const FitsRecord& record);

}  // namespace medial_vk
