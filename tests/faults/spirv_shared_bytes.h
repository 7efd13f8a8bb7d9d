// How much shared memory a SPIR-V module declares.
#pragma once

#include <cstdint>
#include <map>
#include <span>

namespace medial_vk::test {

/// Bytes of its variables in the Workgroup storage class, types laid out without padding.
inline std::uint32_t spirv_shared_bytes(std::span<const std::uint32_t> words) {
  // SPIR-V 1.5, sections 2.3 and 3.37: a header of five words, then instructions (word count << 16 | opcode).
  constexpr std::uint32_t kTypeBool = 20, kTypeInt = 21, kTypeFloat = 22, kTypeVector = 23, kTypeArray = 28,
                          kTypeStruct = 30, kTypePointer = 32, kConstant = 43, kSpecConstant = 50, kVariable = 59;
  constexpr std::uint32_t kWorkgroup = 4;
  std::map<std::uint32_t, std::uint32_t> size, constants, pointee;
  std::uint32_t bytes = 0;
  for (std::size_t at = 5; at < words.size();) {
    const std::uint32_t count = words[at] >> 16, opcode = words[at] & 0xffffu;
    if (count == 0 || at + count > words.size()) break;
    const std::span<const std::uint32_t> w = words.subspan(at, count);
    if (opcode == kTypeBool) size[w[1]] = 4;
    if (opcode == kTypeInt || opcode == kTypeFloat) size[w[1]] = w[2] / 8;
    if (opcode == kTypeVector) size[w[1]] = w[3] * size[w[2]];
    if (opcode == kConstant || opcode == kSpecConstant) constants[w[2]] = w[3];
    if (opcode == kTypeArray) size[w[1]] = constants[w[3]] * size[w[2]];
    if (opcode == kTypeStruct) {
      for (const std::uint32_t member : w.subspan(2)) size[w[1]] += size[member];
    }
    if (opcode == kTypePointer) pointee[w[1]] = w[3];
    if (opcode == kVariable && w[3] == kWorkgroup) bytes += size[pointee[w[1]]];
    at += count;
  }
  return bytes;
}

}  // namespace medial_vk::test
