// Reads scenes by assimp: only in builds with it (MEDIAL_VK_USE_ASSIMP).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"
#include "scene_files/scene_parts.h"

namespace medial_vk {

/// The bytes of a scene, and where they come from.
struct SceneBytes {
  std::string_view bytes;
  std::string name;    ///< For messages.
  std::string format;  ///< An extension without a dot, by which assimp knows the format.
  std::string path;    ///< Of the file; other files of its folder may belong to it. Empty: it stands alone.
  std::uint64_t most_corners = kMostSceneCorners;
};

/// A part for each node that shows faces, in the order of the file, with the transformations of all nodes above it
/// applied; reflections keep faces outside. A mesh that several nodes show is a part for each. Skinned meshes are in
/// the pose of their nodes, shapes to be blended in are left out. Lines and points are no faces. Errors: kInvalidMesh,
/// with the name; in a build without assimp it names the package and the option.
Result<std::vector<ScenePart>> read_scene(const SceneBytes& scene);

}  // namespace medial_vk
