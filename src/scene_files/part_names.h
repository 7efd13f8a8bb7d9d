// Names of the meshes of a scene that can stand in the names of files.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene_files/scene_parts.h"

namespace medial_vk {

/// One name for each part, from its name in the file: of ASCII letters, digits, - and _, at most 64 characters long,
/// never empty, and different from all others even where upper and lower case are the same. A part without a name gets
/// its number, from 1.
std::vector<std::string> safe_part_names(std::span<const ScenePart> parts);

}  // namespace medial_vk
