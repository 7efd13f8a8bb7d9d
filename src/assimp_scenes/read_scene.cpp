#include "assimp_scenes/read_scene.h"

#include <fmt/format.h>

#include "input/read_mesh.h"
#include "input/text_scanner.h"

#if defined(MEDIAL_VK_HAS_ASSIMP)
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <new>

#include "assimp_scenes/archive_size.h"
#include "assimp_scenes/scene_io.h"
#include "assimp_scenes/scene_meshes.h"
#endif

namespace medial_vk {

#if defined(MEDIAL_VK_HAS_ASSIMP)
namespace {

/// A sentence of assimp, which may contain bytes of the file: one line of readable length.
std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 120;
  std::string line;
  for (const char c : text.substr(0, kLongest)) line += c >= 0x20 && c < 0x7f ? c : '?';
  return text.size() > kLongest ? line + "..." : line;
}

/// The name by which assimp requests the scene: its path, with the extension of its format.
std::string main_path_of(const SceneBytes& scene) {
  const std::string path = scene.path.empty() ? "scene" : scene.path;
  return path.ends_with("." + scene.format) ? path : path + "." + scene.format;
}

void configure(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);  // the axes of the file, as in ROS
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);           // no meshes that no file contains
  for (const char* unused :
       {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_TEXTURES, AI_CONFIG_IMPORT_FBX_READ_CAMERAS,
        AI_CONFIG_IMPORT_FBX_READ_LIGHTS, AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS}) {
    importer.SetPropertyBool(unused, false);
  }
}

Result<std::vector<ScenePart>> import(const SceneBytes& scene) {
  const std::string path = main_path_of(scene);
  Assimp::Importer importer;
  configure(importer);
  auto* const io = new SceneIo(path, scene.bytes, !scene.path.empty());
  importer.SetIOHandler(io);  // which owns it
  const aiScene* read = importer.ReadFile(path, 0);
  if (read != nullptr) return meshes_of(*read, scene.name, scene.most_corners);
  std::string reason = io->refusal();
  if (reason.empty()) reason = printable(importer.GetErrorString());
  return file_error(scene.name, fmt::format("assimp cannot read it as .{}: {}", scene.format, reason));
}

}  // namespace

Result<std::vector<ScenePart>> read_scene(const SceneBytes& scene) {
  try {
    if (scene.bytes.empty()) return file_error(scene.name, "file is empty");
    if (expanded_size(scene.bytes) > kMostFileBytes) {
      return file_error(scene.name,
                        fmt::format("expands to more than {} MiB, the most that is read", kMostFileBytes >> 20));
    }
    return import(scene);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", scene.name)};
  } catch (const std::exception& error) {
    return file_error(scene.name,
                      fmt::format("assimp failed on this .{} file: {}", scene.format, printable(error.what())));
  }
}
#else
Result<std::vector<ScenePart>> read_scene(const SceneBytes& scene) {
  return file_error(scene.name,
                    fmt::format("this build reads no .{} files; build with assimp (Debian's libassimp-dev, and "
                                "-DMEDIAL_VK_USE_ASSIMP=ON), or convert it: assimp export FILE.{} FILE.obj",
                                scene.format, scene.format));
}
#endif

}  // namespace medial_vk
