// SPIR-V without denormal numbers, infinities, NaN and signed zeros: devices need not support these (Vulkan 1.2,
// "Floating-Point Environment", if none of the execution modes of SPV_KHR_float_controls is declared).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace medial_vk::test {

/// Replacements of results that a device need not support.
struct OtherSpecials {
  float zero = 0;     ///< Of zeros and denormal numbers: 0 or -0.
  float special = 0;  ///< Of infinities and NaN: any finite number.
};

inline constexpr std::array kOtherSpecials = {OtherSpecials{-0.0f, 0.0f}, OtherSpecials{0.0f, 1e30f},
                                              OtherSpecials{-0.0f, -1e30f}};

/// For the names of tests.
inline const char* name_of(const OtherSpecials& specials) {
  return specials.special == 0 ? "zero" : specials.special > 0 ? "large" : "low";
}

/// The module with every such result of its arithmetic, on numbers and on vectors, replaced.
std::vector<std::uint32_t> replace_specials(std::span<const std::uint32_t> words, const OtherSpecials& specials);

}  // namespace medial_vk::test
