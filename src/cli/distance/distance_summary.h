// The summary of `medial-vk distance`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/options/distance_options.h"
#include "cli/shared/load_body.h"
#include "medial_vk/measurements.h"
#include "medial_vk/mesh.h"
#include "medial_vk/proximity.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

/// A line about a mesh: "part.obj: 5,856 triangles, closed"; with `verbose` also its assumptions.
std::string distance_opening(const std::string& path, const MeshReport& report, bool verbose);

/// The same of a body file, with its balls.
std::string body_file_opening(const std::string& path, const LoadedBody& body, bool verbose);

/// `times` has one of "distances", that of the distances alone. Precondition: there is a distance.
std::string distance_summary(const DistanceCommandOptions& options, std::span<const Distance> distances,
                             const std::vector<StageTime>& times, std::span<const OutputFile> files);
/// The same with --balls.
std::string bounds_summary(const DistanceCommandOptions& options, std::span<const DistanceBounds> bounds,
                           const std::vector<StageTime>& times, std::span<const OutputFile> files);

}  // namespace medial_vk::cli
