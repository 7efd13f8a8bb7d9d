// Loads the mesh as the options require: read, cleaned, perturbed.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "cli/shared/device_opening.h"
#include "medial_vk/mesh.h"
#include "medial_vk/prepare.h"
#include "scene_files/scene_parts.h"

namespace medial_vk::cli {

/// Reads the meshes of a file: with `each` one by one, else all as one. Appends the seconds of "read" to `times`.
/// Errors: kInvalidMesh, kInterrupted.
Result<std::vector<ScenePart>> read_meshes(const std::string& path, bool each, std::vector<StageTime>& times);

/// Cleans a mesh of the file; appends the seconds of "prepare" to `times`. Errors: kInvalidMesh, kInterrupted.
Result<PreparedMesh> prepare_loaded(Mesh mesh, const std::string& path, const DeviceOpening& opening,
                                    const PrepareOptions& options, std::vector<StageTime>& times);

/// Also perturbs the mesh if the options require it, and appends the seconds of "perturb".
Result<PreparedMesh> prepare_loaded(Mesh mesh, const Options& options, const DeviceOpening& opening,
                                    std::vector<StageTime>& times);

}  // namespace medial_vk::cli
