// Other files that belong to a scene: those of its folder, and no others.
#pragma once

#include <string>

#include "medial_vk/result.h"

namespace medial_vk {

/// The folder of the file, without symbolic links; empty if there is none.
std::string folder_of_scene(const std::string& path);

/// The path, without symbolic links, of the regular file that a scene calls `file`, which may have codes such as %20 in
/// it. Nothing outside of `folder` is found, whatever `file` or a link says. Error: kInvalidMesh; the message continues
/// the sentence "it names the file", beginning with its name.
Result<std::string> file_of_folder(const std::string& folder, const std::string& file);

}  // namespace medial_vk
