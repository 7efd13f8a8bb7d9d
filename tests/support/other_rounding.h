// SPIR-V whose operations round differently: the deviations that Vulkan allows to devices, on one device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace medial_vk::test {

/// The relative increase of results.
struct OtherRounding {
  float division = 0;      ///< a / b
  float root = 0;          ///< sqrt, inversesqrt, length, distance, normalize
  float trigonometry = 0;  ///< sin, cos, asin, acos, atan
};

/// The module with every such result multiplied by 1 + its share.
std::vector<std::uint32_t> round_otherwise(std::span<const std::uint32_t> words, const OtherRounding& rounding);

}  // namespace medial_vk::test
