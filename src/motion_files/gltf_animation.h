// The animations of a glTF 2.0 document.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "motion_files/gltf_nodes.h"
#include "motion_files/key_frames.h"
#include "motion_files/moving_mesh.h"

namespace medial_vk {

/// An animation that was chosen by its name or number.
struct GltfAnimation {
  std::string label;          ///< Its name, or its number, for messages and names of frames.
  double start = 0, end = 0;  ///< The times of its first and last key, in seconds.

  struct Channels {
    std::optional<KeyFrames> translation, rotation, scale;
    std::optional<KeyFrames> weights;  ///< Of the shapes of its mesh.
  };
  std::map<std::uint32_t, Channels> channels;  ///< By node.

  /// Changes what the animation moves to its value at a time.
  void apply(double time, std::vector<NodePose>& poses) const;
  /// The weights of the shapes of a part at a time.
  void apply(double time, const MovingMesh::Part& part, std::vector<double>& weights) const;
};

/// The animations by number, from 1, and name, for a message.
std::string list_of_animations(const GltfDocument& document);

/// Which animation has the name, or else the number, from 1; of an empty one the only one. Empty: none.
std::optional<std::uint64_t> find_animation(const GltfDocument& document, const std::string& name_or_number);

/// Reads an animation. Throws GltfFault, also if it moves nothing of the mesh.
GltfAnimation gltf_animation_of(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes,
                                const MovingMesh& mesh, std::uint64_t index);

}  // namespace medial_vk
