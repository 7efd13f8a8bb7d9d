// The mesh as the options want it: read, cleaned, perturbed.
#pragma once

#include <string>
#include <vector>

#include "cli/extract/device_opening.h"
#include "cli/options/options.h"
#include "medial_vk/mesh.h"

namespace medial_vk::cli {

/// Read and cleaned; seconds of "read" and "prepare" are appended to `times`. Errors: kInvalidMesh, kInterrupted.
Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, unsigned threads,
                               std::vector<StageTime>& times);

/// Perturbed, too, if asked for. Seconds of "read", "prepare" and, if asked for, "perturb" are appended to `times`.
/// Errors: kInvalidMesh, kInterrupted.
Result<PreparedMesh> load_mesh(const Options& options, const DeviceOpening& opening, std::vector<StageTime>& times);

}  // namespace medial_vk::cli
