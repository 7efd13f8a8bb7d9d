// A glTF that is put together from its JSON and arrays, for the tests of what reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// Collects the buffer of a glTF, and its views and accessors.
class GltfWriter {
 public:
  static constexpr int kByte = 5121, kUint = 5125, kFloat = 5126;

  nlohmann::json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  std::string buffer;

  int add_accessor(const std::string& bytes, int component, const char* type, std::size_t count,
                   nlohmann::json more = nlohmann::json::object());
  /// Of floats; `type` has `width` of them.
  int add_floats(const std::vector<double>& values, const char* type, std::size_t width);
  nlohmann::json primitive_of(const Mesh& mesh, int mode, bool is_skinned);

  /// The document with its buffer: as text with base64, or as GLB.
  std::string gltf();
  std::string glb();
};

std::string glb_of(const std::string& text, const std::string& buffer);

}  // namespace medial_vk::test
