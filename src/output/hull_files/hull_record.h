// The data of one finished run of `medial-vk fit`, for its files, its summary and its report.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "common/backend.h"
#include "medial_vk/context.h"
#include "medial_vk/hull_fits.h"
#include "medial_vk/measurements.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

struct HullRecord {
  std::string input, output, output_format;
  std::string name;  ///< Of the mesh.
  HullFitOptions options;
  Backend backend = Backend::kVulkan;

  MeshReport mesh;
  HullFit fit;
  std::optional<CheckReport> check;  ///< Of `--check`.
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Seconds, in the order of the run.
};

/// The words of the files: "ball", "capsule", "cone", "slab".
const char* name_of(HullKind kind);
/// The words of the option: "balls", "capsules", "cones", "slabs", "mix".
const char* name_of(HullChoice choice);

/// The number of hulls of each kind, in the order of HullKind.
std::array<std::size_t, 4> kinds_of(std::span<const BallHull> hulls);
/// The sum of parameters_of() the hulls.
std::size_t parameters_in(std::span<const BallHull> hulls);

/// Bounds of the share of the solid's volume that the hulls leave uncovered; none if the mesh encloses no volume.
std::optional<Bounds> uncovered_share(const HullRecord& record);

}  // namespace medial_vk
