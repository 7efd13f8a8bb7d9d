// A .glb read back: its document and its buffer.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace medial_vk::test {

struct Glb {
  nlohmann::json document;
  std::string buffer;
};

inline std::uint32_t glb_word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

/// Section 4 of the specification of glTF 2.0.
inline Glb parse_glb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(glb_word(bytes, 4), 2u);
  EXPECT_EQ(glb_word(bytes, 8), bytes.size());
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  const std::size_t json_length = glb_word(bytes, 12);
  EXPECT_EQ(json_length % 4, 0u);
  Glb glb = {nlohmann::json::parse(bytes.substr(20, json_length)), {}};
  const std::size_t next = 20 + json_length;
  if (next == bytes.size()) return glb;
  EXPECT_EQ(bytes.substr(next + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(glb_word(bytes, next) % 4, 0u);
  EXPECT_EQ(next + 8 + glb_word(bytes, next), bytes.size());
  glb.buffer = bytes.substr(next + 8);
  EXPECT_EQ(glb.document["buffers"][0]["byteLength"], glb.buffer.size());
  return glb;
}

inline std::vector<std::array<float, 3>> vectors(const Glb& glb, std::size_t accessor) {
  const nlohmann::json& description = glb.document["accessors"][accessor];
  EXPECT_EQ(description["componentType"], 5126);
  EXPECT_EQ(description["type"], "VEC3");
  const nlohmann::json& view = glb.document["bufferViews"][description["bufferView"].get<std::size_t>()];
  std::vector<std::array<float, 3>> out(description["count"].get<std::size_t>());
  EXPECT_EQ(view["byteLength"], out.size() * 12);
  const auto offset = view["byteOffset"].get<std::size_t>();
  EXPECT_EQ(offset % 4, 0u);
  for (std::size_t i = 0; i < 3 * out.size(); ++i) {
    const std::uint32_t bits = glb_word(glb.buffer, offset + 4 * i);
    std::memcpy(&out[i / 3][i % 3], &bits, 4);
  }
  return out;
}

}  // namespace medial_vk::test
