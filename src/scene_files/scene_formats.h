// The formats that assimp reads for this program: files of scenes, with any number of meshes.
#pragma once

#include <string>
#include <string_view>

namespace medial_vk {

/// The extension, without a dot, by which assimp knows the format of a file; empty: it is none of these formats.
/// Content decides where it is unambiguous (GLB, binary FBX, COLLADA, a zip, which is then 3MF), and else the extension
/// of `name`. OBJ, PLY, STL and OFF are never among them: this program reads those itself.
std::string scene_format_of(std::string_view bytes, const std::string& name);

/// Whether the extension of a name, in upper or lower case, is that of a format of meshes that this program reads.
bool is_name_of_mesh(const std::string& name);

}  // namespace medial_vk
