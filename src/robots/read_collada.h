// COLLADA (.dae), the format of many robots' visual meshes, by assimp: only in builds with it (MEDIAL_VK_COLLADA).
#pragma once

#include <string>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// All meshes of the scene in its root frame, in metres by the unit of the file. Errors: kInvalidMesh; in a build
/// without assimp the message names its absence, and a way to convert the file.
Result<Mesh> read_collada(const std::string& path);

}  // namespace medial_vk
