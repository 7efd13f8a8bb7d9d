// All that is known of one finished run of `medial-vk spheres`: what is printed and reported.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/spheres/spheres_options.h"
#include "judge/check_spheres.h"
#include "medial_vk/context.h"
#include "output/files/atomic_file.h"
#include "robots/fit_parts.h"

namespace medial_vk::cli {

struct SpheresRecord {
  std::string robot;                                                ///< Name of the robot or mesh.
  std::vector<Part> parts;                                          ///< What was fitted to ...
  std::vector<PartFit> fits;                                        ///< ... and what came of it, in the same order.
  std::vector<std::optional<reference::Certificate>> certificates;  ///< Of --check, in the same order.
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Seconds, in the order of the run.
};

/// Words of the options.
const char* name_of(SphereContract contract);
const char* name_of(SphereMethod method);

/// Of the last level of all parts.
std::size_t count_spheres(const SpheresRecord& record);
/// Share of the volume that balls inside leave uncovered; nothing if a mesh encloses no volume, or for other contracts.
std::optional<double> uncovered_share(const PartFit& fit, SphereContract contract);
std::optional<double> uncovered_share(const SpheresRecord& record, SphereContract contract);

/// Of all parts, one line for each condition; `first_failure` names the link.
reference::Certificate joint_certificate(const SpheresRecord& record);

/// One line before the work: what was read, where it runs.
std::string spheres_opening(const SpheresOptions& options, const SpheresRecord& record);
/// A few lines at the end; `files` have been written.
std::string spheres_summary(const SpheresOptions& options, const SpheresRecord& record,
                            std::span<const OutputFile> files);
/// For -v: a line for each part.
std::string spheres_details(const SpheresOptions& options, const SpheresRecord& record);
/// JSON; every key is described in docs/report.md.
std::string spheres_report(const SpheresOptions& options, const SpheresRecord& record);

}  // namespace medial_vk::cli
