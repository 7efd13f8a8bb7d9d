// COLLADA (.dae), which many robots' visual meshes are, by assimp: only in builds with it (MEDIAL_VK_COLLADA).
#pragma once

#include <string>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// All meshes of the scene in its root frame, in the file's unit as metres. Errors: kInvalidMesh; in a build without
/// assimp it says so, and how to convert the file.
Result<Mesh> read_collada(const std::string& path);

}  // namespace medial_vk
