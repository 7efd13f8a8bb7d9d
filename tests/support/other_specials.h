// SPIR-V without denormal numbers, infinities, NaN and a sign of zero of its own: devices need not have these (Vulkan
// 1.2, "Floating-Point Environment", where none of the execution modes of SPV_KHR_float_controls is declared).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace medial_vk::test {

/// What comes in the place of results that a device need not have.
struct OtherSpecials {
  float zero = 0;     ///< Of zeros and denormal numbers: 0 or -0.
  float special = 0;  ///< Of infinities and NaN: any finite number.
};

/// The module with every result of its arithmetic, of numbers and of vectors, replaced so.
std::vector<std::uint32_t> replace_specials(std::span<const std::uint32_t> words, const OtherSpecials& specials);

}  // namespace medial_vk::test
