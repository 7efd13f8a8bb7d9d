// What a file's name says of its format.
#pragma once

#include <string>

namespace medial_vk {

/// With its dot, in lower case: ".ply" of "Part.PLY"; empty if there is none.
std::string file_extension(const std::string& path);

}  // namespace medial_vk
