// The program medial-vk-read-scene, in which assimp runs: a file that makes assimp crash, or take memory or time
// without end, ends that program and not this one.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"
#include "scene_files/scene_parts.h"

namespace medial_vk {

/// The bytes of a scene in memory, and what is known of it.
struct SceneFile {
  std::string bytes;
  std::string name;    ///< For messages.
  std::string format;  ///< As scene_format_of() returns it.
  std::string path;    ///< Of the file; other files of its folder may belong to it. Empty: it stands alone.
};

/// Lets the program read the scene. Errors: kInvalidMesh if it cannot be read, or if the program crashed or was stopped
/// at a limit; also if it is not installed. kOutOfMemory.
Result<std::vector<ScenePart>> read_scene_apart(SceneFile file);

}  // namespace medial_vk
