// Compares the requirements of calls with the limits that the device has reported.
#pragma once

#include <algorithm>
#include <cstring>
#include <mutex>
#include <string>

#include "spirv_shared_bytes.h"
#include "vulkan_calls.h"
#include "vulkan_interposer.h"

namespace medial_vk::test::hooks {

// The requirements of a call, before it is made: overloads for the relevant calls.
template <class Tag, class... Args>
void check_call(Tag, Args...) {}

inline void check(VulkanInterposer& self, const char* what, std::uint64_t required, std::uint64_t limit) {
  if (required > limit)
    self.violation(std::string(what) + ": " + std::to_string(required) + " where " + std::to_string(limit) +
                   " is allowed");
}

inline void check_call(vkCreateDescriptorSetLayoutTag, VkDevice, const VkDescriptorSetLayoutCreateInfo* info,
                       const VkAllocationCallbacks*, VkDescriptorSetLayout*) {
  std::uint32_t storage = 0, texels = 0;
  for (std::uint32_t i = 0; i < info->bindingCount; ++i) {
    const bool is_storage = info->pBindings[i].descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    (is_storage ? storage : texels) += info->pBindings[i].descriptorCount;
  }
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "storage buffers of a stage", storage, self.limits.maxPerStageDescriptorStorageBuffers);
  check(self, "storage buffers of a set", storage, self.limits.maxDescriptorSetStorageBuffers);
  check(self, "texel buffers of a stage", texels, self.limits.maxPerStageDescriptorSampledImages);
  check(self, "resources of a stage", storage + texels, self.limits.maxPerStageResources);
  self.use([&](Usage& u) {
    u.storage_buffers = std::max(u.storage_buffers, storage);
    u.texel_buffers = std::max(u.texel_buffers, texels);
    u.buffers = std::max(u.buffers, storage + texels);
  });
}

inline void check_call(vkCreatePipelineLayoutTag, VkDevice, const VkPipelineLayoutCreateInfo* info,
                       const VkAllocationCallbacks*, VkPipelineLayout*) {
  std::uint32_t bytes = 0;
  for (std::uint32_t i = 0; i < info->pushConstantRangeCount; ++i)
    bytes = std::max(bytes, info->pPushConstantRanges[i].offset + info->pPushConstantRanges[i].size);
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "bytes of push constants", bytes, self.limits.maxPushConstantsSize);
  check(self, "bound sets", info->setLayoutCount, self.limits.maxBoundDescriptorSets);
  self.use([&](Usage& u) {
    u.push_constant_bytes = std::max(u.push_constant_bytes, bytes);
    u.sets = std::max(u.sets, info->setLayoutCount);
  });
}

inline void check_call(vkCreateShaderModuleTag, VkDevice, const VkShaderModuleCreateInfo* info,
                       const VkAllocationCallbacks*, VkShaderModule*) {
  const std::uint32_t bytes = spirv_shared_bytes({info->pCode, info->codeSize / sizeof(std::uint32_t)});
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "bytes of shared memory", bytes, self.limits.maxComputeSharedMemorySize);
  self.use([&](Usage& u) { u.shared_bytes = std::max(u.shared_bytes, bytes); });
}

// The library's convention: the workgroup's size along x is specialization constant 0, and it is one high and deep.
inline void check_call(vkCreateComputePipelinesTag, VkDevice, VkPipelineCache, std::uint32_t,
                       const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks*, VkPipeline*) {
  std::uint32_t size = 0;
  std::memcpy(&size, info->stage.pSpecializationInfo->pData, sizeof(size));
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "invocations of a workgroup", size, self.limits.maxComputeWorkGroupInvocations);
  check(self, "width of a workgroup", size, self.limits.maxComputeWorkGroupSize[0]);
  self.use([&](Usage& u) { u.workgroup_size = std::max(u.workgroup_size, size); });
}

inline void check_call(vkCreateBufferViewTag, VkDevice, const VkBufferViewCreateInfo* info,
                       const VkAllocationCallbacks*, VkBufferView*) {
  VulkanInterposer& self = VulkanInterposer::get();
  const std::lock_guard lock(self.buffers_mutex);
  const VkDeviceSize bytes =
      info->range == VK_WHOLE_SIZE ? self.buffer_sizes[info->buffer] - info->offset : info->range;
  check(self, "texels of a view", bytes / 16, self.limits.maxTexelBufferElements);
}

inline void dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const InDriver inside;
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "groups along x", x, self.limits.maxComputeWorkGroupCount[0]);
  check(self, "groups along y", y, self.limits.maxComputeWorkGroupCount[1]);
  call_real<vkCmdDispatchTag>(commands, x, y, z);
}

}  // namespace medial_vk::test::hooks
