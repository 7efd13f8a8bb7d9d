// What the kernels need of a device beyond its being there: the one place where these numbers are.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>
#include <string>

namespace medial_vk {

/// A limit that must not be lower. The least that Vulkan 1.2 promises is below some of them (docs/reliability.md).
struct RequiredLimit {
  const char* name;  // as in VkPhysicalDeviceLimits
  std::uint32_t needed;
  std::uint32_t& (*of)(VkPhysicalDeviceLimits&);
};

std::span<const RequiredLimit> required_limits();

/// "its maxPerStageDescriptorStorageBuffers is 4, 16 are needed", for the first that is too low; empty: none is.
std::string limit_too_low(VkPhysicalDeviceLimits limits);

}  // namespace medial_vk
