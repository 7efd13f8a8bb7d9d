// The device limits that the kernels require; these numbers are defined only here.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/context.h"

namespace medial_vk {

/// A limit that must not be lower. The minimum guaranteed by Vulkan 1.2 is below some of them (docs/reliability.md).
struct RequiredLimit {
  const char* name;  // as in VkPhysicalDeviceLimits
  std::uint32_t needed;
  std::uint32_t& (*of)(VkPhysicalDeviceLimits&);
};

std::span<const RequiredLimit> required_limits();

/// Each of them with its value on a device.
std::vector<DeviceLimit> compare_limits(VkPhysicalDeviceLimits limits);

/// "its maxPerStageDescriptorStorageBuffers is 4, 16 are needed", for each limit that is too low.
std::vector<std::string> limits_too_low(const std::vector<DeviceLimit>& limits);

}  // namespace medial_vk
