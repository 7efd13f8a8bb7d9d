#include "support/scenes/gltf_writer.h"

#include <algorithm>

#include "support/solids/mesh_files.h"

namespace medial_vk::test {
namespace {

using nlohmann::json;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string word(std::uint32_t value) { return bytes_of(value, false); }

}  // namespace

int GltfWriter::add_accessor(const std::string& bytes, int component, const char* type, std::size_t count, json more) {
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
  buffer += bytes;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  json accessor = {{"bufferView", document["bufferViews"].size() - 1},
                   {"componentType", component},
                   {"count", count},
                   {"type", type}};
  accessor.update(more);
  document["accessors"].push_back(accessor);
  return static_cast<int>(document["accessors"].size()) - 1;
}

json GltfWriter::primitive_of(const Mesh& mesh, int mode, bool is_skinned) {
  std::string positions, indices, joints, weights;
  Point lower = mesh.vertices.at(0), upper = lower;
  for (const Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      positions += bytes_of(static_cast<float>(p[k]), false);
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
    joints += std::string(4, '\0');
    for (const float weight : {1.f, 0.f, 0.f, 0.f}) weights += bytes_of(weight, false);
  }
  const unsigned corners = mode == 4 ? 3 : mode == 1 ? 2 : 1;
  for (const Triangle& t : mesh.triangles) {
    for (unsigned k = 0; k < corners; ++k) indices += bytes_of(t[k], false);
  }
  json primitive = {{"mode", mode}};
  primitive["attributes"]["POSITION"] =
      add_accessor(positions, kFloat, "VEC3", mesh.vertices.size(), {{"min", lower}, {"max", upper}});
  primitive["indices"] = add_accessor(indices, kUint, "SCALAR", corners * mesh.triangles.size());
  if (is_skinned) {
    primitive["attributes"]["JOINTS_0"] = add_accessor(joints, kByte, "VEC4", mesh.vertices.size());
    primitive["attributes"]["WEIGHTS_0"] = add_accessor(weights, kFloat, "VEC4", mesh.vertices.size());
  }
  return primitive;
}

int GltfWriter::add_floats(const std::vector<double>& values, const char* type, std::size_t width) {
  std::string bytes;
  for (const double value : values) bytes += bytes_of(static_cast<float>(value), false);
  return add_accessor(bytes, kFloat, type, values.size() / width);
}

std::string GltfWriter::gltf() {
  document["buffers"] =
      json::array({{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}});
  return document.dump();
}

std::string GltfWriter::glb() {
  document["buffers"] = json::array({{{"byteLength", buffer.size()}}});
  return glb_of(document.dump(), buffer);
}

std::string glb_of(const std::string& text, const std::string& buffer) {
  const std::string padded = text + std::string((4 - text.size() % 4) % 4, ' ');
  const std::string chunks = word(static_cast<std::uint32_t>(padded.size())) + "JSON" + padded +
                             word(static_cast<std::uint32_t>(buffer.size())) + std::string("BIN\0", 4) + buffer;
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

}  // namespace medial_vk::test
