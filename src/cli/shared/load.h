// Loads the mesh as the options require: read, cleaned, perturbed.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "cli/shared/device_opening.h"
#include "medial_vk/mesh.h"
#include "medial_vk/prepare.h"

namespace medial_vk::cli {

/// Reads and cleans the mesh; appends the seconds of "read" and "prepare" to `times`. Errors: kInvalidMesh,
/// kInterrupted.
Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, const PrepareOptions& options,
                               std::vector<StageTime>& times);

/// Also perturbs the mesh if the options require it. Appends the seconds of "read", "prepare" and, if requested,
/// "perturb" to `times`. Errors: kInvalidMesh, kInterrupted.
Result<PreparedMesh> load_mesh(const Options& options, const DeviceOpening& opening, std::vector<StageTime>& times);

}  // namespace medial_vk::cli
