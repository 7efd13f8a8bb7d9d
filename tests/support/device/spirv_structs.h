// Reads the memory layout of structures from SPIR-V modules: the layout that a shader compiler gave to shared
// declarations.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/device/spirv_walk.h"

namespace medial_vk::test {

/// One structure with Offset decorations, as one module declares it.
struct SpirvStruct {
  std::string name;
  std::map<std::uint32_t, std::string> names;      ///< By member.
  std::map<std::uint32_t, std::uint32_t> offsets;  ///< By member, bytes.
  std::uint32_t stride = 0;                        ///< Of an array of it, 0 if the module has none.
};

/// Every structure of the module that has Offset decorations (those without are private copies in registers).
inline std::vector<SpirvStruct> read_spirv_structs(std::span<const std::uint32_t> words) {
  constexpr std::uint32_t kArrayStride = 6, kOffset = 35;  // decorations
  std::map<std::uint32_t, SpirvStruct> structs;
  std::map<std::uint32_t, std::uint32_t> strides;  // by array type
  std::map<std::uint32_t, bool> is_struct;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> arrays;  // array type, element type
  const auto text = [](std::span<const std::uint32_t> literal) {
    std::string out;
    for (const std::uint32_t word : literal) {
      for (int byte = 0; byte < 4; ++byte) {
        const char c = static_cast<char>(word >> (8 * byte) & 0xffu);
        if (c == '\0') return out;
        out += c;
      }
    }
    return out;
  };
  spirv::for_each_instruction(words, [&](std::uint32_t code, std::span<const std::uint32_t> w) {
    if (code == spirv::kName) structs[w[1]].name = text(w.subspan(2));
    if (code == spirv::kMemberName) structs[w[1]].names[w[2]] = text(w.subspan(3));
    if (code == spirv::kMemberDecorate && w[3] == kOffset) structs[w[1]].offsets[w[2]] = w[4];
    if (code == spirv::kDecorate && w[2] == kArrayStride) strides[w[1]] = w[3];
    if (code == spirv::kTypeArray || code == spirv::kTypeRuntimeArray) arrays.emplace_back(w[1], w[2]);
    if (code == spirv::kTypeStruct) is_struct[w[1]] = true;
  });
  for (const auto& [array, element] : arrays) {
    if (is_struct.contains(element) && strides.contains(array)) structs[element].stride = strides[array];
  }
  std::vector<SpirvStruct> out;
  for (auto& [id, found] : structs) {
    if (is_struct.contains(id) && !found.offsets.empty()) out.push_back(std::move(found));
  }
  return out;
}

}  // namespace medial_vk::test
