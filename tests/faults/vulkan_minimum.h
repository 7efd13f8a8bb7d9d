// The poorest device that Vulkan 1.2 allows ("Required Limits" of its specification), as far as compute is concerned.
#pragma once

#include "device/required_limits.h"
#include "vulkan_interposer.h"

namespace medial_vk::test {

inline void lower_to_minimum(VkPhysicalDeviceLimits& l) {
  l.maxUniformBufferRange = 16384;
  l.maxStorageBufferRange = 1u << 27;
  l.maxTexelBufferElements = 65536;
  l.maxPushConstantsSize = 128;
  l.maxMemoryAllocationCount = 4096;
  l.bufferImageGranularity = 131072;
  l.maxBoundDescriptorSets = 4;
  l.maxPerStageDescriptorUniformBuffers = 12;
  l.maxPerStageDescriptorStorageBuffers = 4;
  l.maxPerStageDescriptorSampledImages = 16;
  l.maxPerStageDescriptorStorageImages = 4;
  l.maxPerStageResources = 128;
  l.maxDescriptorSetUniformBuffers = 72;
  l.maxDescriptorSetStorageBuffers = 24;
  l.maxDescriptorSetSampledImages = 96;
  l.maxDescriptorSetStorageImages = 24;
  l.maxComputeSharedMemorySize = 16384;
  for (std::uint32_t& count : l.maxComputeWorkGroupCount) count = 65535;
  l.maxComputeWorkGroupInvocations = 128;
  l.maxComputeWorkGroupSize[0] = 128;
  l.maxComputeWorkGroupSize[1] = 128;
  l.maxComputeWorkGroupSize[2] = 64;
  l.minTexelBufferOffsetAlignment = 256;
  l.minUniformBufferOffsetAlignment = 256;
  l.minStorageBufferOffsetAlignment = 256;
  l.nonCoherentAtomSize = 256;
  l.timestampComputeAndGraphics = VK_FALSE;
}

/// The minimum of everything; with `usable`, plus the requirements of the library.
inline DeviceProfile minimum_profile(bool usable) {
  DeviceProfile profile;
  profile.limits = [usable](VkPhysicalDeviceLimits& limits) {
    lower_to_minimum(limits);
    if (!usable) return;
    for (const RequiredLimit& required : required_limits())
      if (required.of(limits) < required.needed) required.of(limits) = required.needed;
  };
  profile.max_allocation_bytes = VkDeviceSize{1} << 30;
  profile.timestamp_valid_bits = 0;
  profile.no_subgroup_operations = true;
  profile.split_memory = true;
  return profile;
}

}  // namespace medial_vk::test
