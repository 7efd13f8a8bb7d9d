// The summary of `medial-vk distance`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/options/distance_options.h"
#include "medial_vk/measurements.h"
#include "medial_vk/mesh.h"
#include "medial_vk/proximity.h"

namespace medial_vk::cli {

/// A line about a mesh: "part.obj: 5,856 triangles, closed"; with `verbose` also its assumptions.
std::string distance_opening(const std::string& path, const MeshReport& report, bool verbose);

/// The last of `times` is that of the distances alone. `bytes`: the size of the table. Precondition: there is a
/// distance.
std::string distance_summary(const DistanceCommandOptions& options, std::span<const Distance> distances,
                             const std::vector<StageTime>& times, std::size_t bytes);

}  // namespace medial_vk::cli
