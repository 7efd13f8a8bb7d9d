#include "scene_files/scene_formats.h"

#include <algorithm>
#include <iterator>

#include "common/file_extension.h"

namespace medial_vk {
namespace {

/// Of assimp 5.2: formats with meshes. Those that hold movements only are left out.
constexpr std::string_view kExtensions[] = {
    "3d",   "3ds", "3mf",     "ac",   "ac3d", "acc",  "amf",  "ase", "ask",     "assbin", "b3d", "blend",
    "bsp",  "cob", "csm",     "dae",  "dxf",  "enff", "fbx",  "glb", "gltf",    "hmp",    "ifc", "ifczip",
    "iqm",  "irr", "irrmesh", "lwo",  "lws",  "lxo",  "md2",  "md3", "md5mesh", "mdc",    "mdl", "mesh",
    "ms3d", "ndo", "nff",     "ogex", "pk3",  "pmx",  "prj",  "q3o", "q3s",     "scn",    "sib", "smd",
    "step", "stp", "ter",     "uc",   "x",    "x3d",  "x3db", "xgl", "zae",     "zgl"};

constexpr std::string_view kOwn[] = {"obj", "ply", "stl", "off"};

bool is_among(std::string_view word, auto& words) { return std::ranges::find(words, word) != std::end(words); }

}  // namespace

std::string scene_format_of(std::string_view bytes, const std::string& name) {
  std::string extension = file_extension(name);
  if (!extension.empty()) extension.erase(0, 1);
  if (bytes.starts_with("glTF")) return "glb";
  if (bytes.starts_with("Kaydara FBX Binary")) return "fbx";
  const bool is_known = is_among(extension, kExtensions);
  if (bytes.starts_with("PK\3\4") && !is_known) return "3mf";
  if (is_known) return extension;
  if (is_among(extension, kOwn)) return {};
  const std::string_view start = bytes.substr(0, 4096);
  const std::size_t first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos) return {};
  if (start[first] == '<' && start.find("<COLLADA") != std::string_view::npos) return "dae";
  if (start[first] == '{' && bytes.find("\"asset\"") != std::string_view::npos) return "gltf";
  return {};
}

bool is_name_of_mesh(const std::string& name) {
  std::string extension = file_extension(name);
  if (!extension.empty()) extension.erase(0, 1);
  return is_among(extension, kExtensions) || is_among(extension, kOwn);
}

}  // namespace medial_vk
