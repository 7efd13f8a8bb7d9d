// From assimp's scene to meshes in one frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/result.h"
#include "scene_files/scene_parts.h"

struct aiScene;

namespace medial_vk {

/// The parts of a scene as read_scene() describes them. All of its indices are tested. Errors: kInvalidMesh, with
/// `name`; also if the faces of all parts have more than `most_corners`, which is tested before memory is allocated.
Result<std::vector<ScenePart>> meshes_of(const aiScene& scene, const std::string& name, std::uint64_t most_corners);

}  // namespace medial_vk
