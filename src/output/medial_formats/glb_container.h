// The binary container of glTF 2.0: a JSON document and one buffer that its accessors describe.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"

namespace medial_vk {

using GltfJson = nlohmann::ordered_json;

/// The numbers and targets of glTF 2.0 are those of OpenGL.
enum class GltfComponent : std::uint32_t { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum class GltfTarget : std::uint32_t { kNone = 0, kVertices = 34962, kIndices = 34963 };

class GlbContainer {
 public:
  /// The whole document except "accessors", "bufferViews" and "buffers", which this class generates, and "nodes", which
  /// are given as text at the end: as a tree, those of all balls would take several times the memory of the file.
  GltfJson document;

  /// Three floats each. With `bounds` the least and the greatest coordinates are recorded too, as positions require.
  /// This function and the next four return the index of the accessor.
  std::size_t add_vectors(std::span<const std::array<float, 3>> vectors, GltfTarget target, bool bounds);
  std::size_t add_indices(std::span<const std::uint32_t> indices, GltfComponent component);
  /// Attributes of one number for each vertex.
  std::size_t add_numbers(std::span<const float> numbers);
  /// Seconds, ascending, as the input of animations.
  std::size_t add_times(std::span<const float> times);
  /// Components are fractions of 65535.
  std::size_t add_colours(std::span<const std::array<std::uint16_t, 4>> colours);

  /// The file. `nodes`: the text of a JSON array. Error kCannotWrite: the file would exceed the size limit of its
  /// format.
  Result<std::string> finish(const std::string& nodes);

  /// The same as a .gltf: the document alone, with the bytes of the buffer in it. `base64` encodes them.
  std::string finish_as_text(const std::string& nodes, const std::function<std::string(std::string_view)>& base64);

 private:
  /// The text of the document; `uri` is where the buffer is, or empty.
  std::string text_of_document(const std::string& nodes, const std::string& uri);
  std::size_t add_accessor(std::size_t begin, GltfTarget target, GltfJson accessor);

  GltfJson accessors_ = GltfJson::array();
  GltfJson views_ = GltfJson::array();
  std::string buffer_;
};

/// The attributes and indices of a primitive, a sphere around the origin (output/medial_formats/icosphere.h) with all
/// vertices in the unit ball.
GltfJson add_unit_ball(GlbContainer& glb, std::uint32_t detail);

}  // namespace medial_vk
