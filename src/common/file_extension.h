// The extension of a file name, which indicates its format.
#pragma once

#include <string>

namespace medial_vk {

/// The extension with its dot, in lower case: ".ply" for "Part.PLY"; empty if there is none.
std::string file_extension(const std::string& path);

}  // namespace medial_vk
