// Any mesh file: OBJ, PLY, STL and OFF by the readers of this program, all other formats by assimp.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"
#include "scene_files/scene_parts.h"

namespace medial_vk {

/// Reads a file, or standard input if its name is "-". The meshes of a scene are one mesh. Errors: kInvalidMesh and
/// kOutOfMemory, with the name of the file.
Result<Mesh> read_mesh_file(const std::string& path);

/// The same, with the meshes of a scene one by one. Of OBJ, PLY, STL and OFF there is one part, without a name.
Result<std::vector<ScenePart>> read_mesh_parts(const std::string& path);

}  // namespace medial_vk
