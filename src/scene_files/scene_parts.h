// The meshes of a scene, and the bytes in which the program that reads scenes hands them over.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The most corners that the faces of a scene may have, each instance of a mesh counted: those of 16 million triangles,
/// twice as many as a device supports. A small file can place a large mesh thousands of times.
inline constexpr std::uint64_t kMostSceneCorners = 3ull << 24;

/// What one node of a scene shows, in the frame of the scene.
struct ScenePart {
  std::string name;  ///< As in the file: any bytes; may be empty.
  Mesh mesh;
};

/// The parts or the error as bytes, for one machine: numbers are in its own order.
std::string encode_scene(const Result<std::vector<ScenePart>>& scene);

/// The inverse. It trusts no byte: indices of the result are valid and its coordinates finite. Bytes that
/// encode_scene() does not make are an error kInternal.
Result<std::vector<ScenePart>> decode_scene(std::string_view bytes);

/// All parts as one mesh. Error: kInvalidMesh if they have too many vertices; `name` is used in the message.
Result<Mesh> join_parts(std::vector<ScenePart> parts, const std::string& name);

}  // namespace medial_vk
