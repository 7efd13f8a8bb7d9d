// The data of one finished run of `medial-vk spheres`, for the summary and the report.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "common/backend.h"
#include "medial_vk/context.h"
#include "medial_vk/part_fits.h"
#include "medial_vk/spheres.h"

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

  std::string name;                  ///< Of the mesh or robot.
  std::vector<Part> solids;          ///< The mesh, with its name as both names, or the parts of the robot,
  std::vector<PartFit> fits;         ///< their fits, in the same order,
  std::vector<double> facet_shares;  ///< PartOrigin::facet_share of each, 0 of a mesh,
  std::vector<std::optional<CheckReport>> checks;  ///< and the results of --check, else empty.
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Seconds, in the order of the run.
};

/// The names used by the options and in the report.
const char* name_of(SphereContract contract);
const char* name_of(SphereMethod method);

/// The fit of a mesh, for which `wanted` balls were requested (0: no number), in its own frame.
PartFit fit_of_mesh(SphereFit fit, std::size_t wanted);

/// The number of spheres of the last level of all solids.
std::size_t count_spheres(const FitsRecord& record);
/// The share of the volume that balls inside leave uncovered; none if a mesh encloses no volume, or for other
/// contracts.
std::optional<double> uncovered_share(const PartFit& fit, SphereContract contract);
std::optional<double> uncovered_share(const FitsRecord& record);

}  // namespace medial_vk
