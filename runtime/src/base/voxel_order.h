#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace medial_vk {

/// Voxel order: z slowest, then y, then x.
inline bool is_earlier_voxel(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

}  // namespace medial_vk
