// The device limits that the kernels require; these numbers are defined only here.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>
#include <string>

namespace medial_vk {

/// A limit that must not be lower. The minimum guaranteed by Vulkan 1.2 is below some of them (docs/reliability.md).
struct RequiredLimit {
  const char* name;  // as in VkPhysicalDeviceLimits
  std::uint32_t needed;
  std::uint32_t& (*of)(VkPhysicalDeviceLimits&);
};

std::span<const RequiredLimit> required_limits();

/// "its maxPerStageDescriptorStorageBuffers is 4, 16 are needed", for the first limit that is too low; empty if none
/// is.
std::string limit_too_low(VkPhysicalDeviceLimits limits);

}  // namespace medial_vk
