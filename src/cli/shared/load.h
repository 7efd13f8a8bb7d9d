// Loads the mesh as the options require: read, cleaned, perturbed.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "cli/shared/device_opening.h"
#include "medial_vk/mesh.h"
#include "scene_files/scene_parts.h"

namespace medial_vk::cli {

/// Reads and cleans the mesh; appends the seconds of "read" and "prepare" to `times`. Errors: kInvalidMesh,
/// kInterrupted.
Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, unsigned threads,
                               std::vector<StageTime>& times);

/// Reads the meshes of the input: with --each one by one, else all as one. Appends the seconds of "read" to `times`.
/// Errors: kInvalidMesh, kInterrupted.
Result<std::vector<ScenePart>> read_meshes(const Options& options, std::vector<StageTime>& times);

/// Cleans a mesh of the input, and perturbs it if the options require it. Appends the seconds of "prepare" and, if
/// requested, "perturb" to `times`. Errors: kInvalidMesh, kInterrupted.
Result<PreparedMesh> prepare_loaded(Mesh mesh, const Options& options, const DeviceOpening& opening,
                                    std::vector<StageTime>& times);

}  // namespace medial_vk::cli
