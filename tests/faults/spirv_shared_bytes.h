// The amount of shared memory that a SPIR-V module declares.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "support/device/spirv_walk.h"

namespace medial_vk::test {

/// Bytes of its variables in the Workgroup storage class, types laid out without padding.
inline std::uint32_t spirv_shared_bytes(std::span<const std::uint32_t> words) {
  constexpr std::uint32_t kWorkgroup = 4;  // a storage class
  std::map<std::uint32_t, std::uint32_t> size, constants, pointee;
  std::uint32_t bytes = 0;
  spirv::for_each_instruction(words, [&](std::uint32_t code, std::span<const std::uint32_t> w) {
    if (code == spirv::kTypeBool) size[w[1]] = 4;
    if (code == spirv::kTypeInt || code == spirv::kTypeFloat) size[w[1]] = w[2] / 8;
    if (code == spirv::kTypeVector) size[w[1]] = w[3] * size[w[2]];
    if (code == spirv::kConstant || code == spirv::kSpecConstant) constants[w[2]] = w[3];
    if (code == spirv::kTypeArray) size[w[1]] = constants[w[3]] * size[w[2]];
    if (code == spirv::kTypeStruct) {
      for (const std::uint32_t member : w.subspan(2)) size[w[1]] += size[member];
    }
    if (code == spirv::kTypePointer) pointee[w[1]] = w[3];
    if (code == spirv::kVariable && w[3] == kWorkgroup) bytes += size[pointee[w[1]]];
  });
  return bytes;
}

}  // namespace medial_vk::test
