// The animated scene with its balls as nodes below the joints (docs/formats.md, "Balls as nodes of a scene").
#pragma once

#include <string>

#include "medial_vk/result.h"
#include "output/rig_files/rig_json.h"

namespace medial_vk {

/// Whether the scene has parts in other files: its copy must then be in the same folder.
bool names_other_files(const GltfSource& source);

/// A copy of `source`, of which `file` has the rig, as glTF or as GLB. Every ball with a radius is bound to one joint,
/// and is a node below it, whose unit ball lies within the ball in every frame, and is that ball where the joint does
/// not scale. Error kCannotWrite: the file would exceed the size limit of GLB.
Result<std::string> encode_rig_gltf(const RigFile& file, const GltfSource& source, bool is_glb);

}  // namespace medial_vk
