// The content of a mesh as a short text.
#pragma once

#include <string>

#include "medial_vk/mesh.h"

namespace medial_vk::cli {

/// The Digest of the mesh as it was read, whatever its format and the files that it was in.
std::string mesh_digest(const Mesh& mesh);

}  // namespace medial_vk::cli
