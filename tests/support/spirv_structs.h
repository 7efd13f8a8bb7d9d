// Reads the memory layout of structures out of SPIR-V modules: what a shader compiler made of shared declarations.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

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
  // SPIR-V 1.5, sections 2.3 and 3.37: a header of five words, then instructions (word count << 16 | opcode).
  constexpr std::uint32_t kName = 5, kMemberName = 6, kTypeArray = 28, kTypeRuntimeArray = 29, kTypeStruct = 30,
                          kDecorate = 71, kMemberDecorate = 72, kArrayStride = 6, kOffset = 35;
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
  for (std::size_t at = 5; at < words.size();) {
    const std::uint32_t count = words[at] >> 16, opcode = words[at] & 0xffffu;
    if (count == 0 || at + count > words.size()) break;
    const std::span<const std::uint32_t> w = words.subspan(at, count);
    if (opcode == kName) structs[w[1]].name = text(w.subspan(2));
    if (opcode == kMemberName) structs[w[1]].names[w[2]] = text(w.subspan(3));
    if (opcode == kMemberDecorate && w[3] == kOffset) structs[w[1]].offsets[w[2]] = w[4];
    if (opcode == kDecorate && w[2] == kArrayStride) strides[w[1]] = w[3];
    if (opcode == kTypeArray || opcode == kTypeRuntimeArray) arrays.emplace_back(w[1], w[2]);
    if (opcode == kTypeStruct) is_struct[w[1]] = true;
    at += count;
  }
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
