// The pretended properties of a device (DeviceProfile), and calls that are converted into those that the real one
// takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "limit_checks.h"
#include "vulkan_calls.h"
#include "vulkan_interposer.h"

namespace medial_vk::test::hooks {

// Conversions of calls before the real ones receive them: overloads for the affected calls.
template <class Tag, class... Args>
VkResult make_call(Tag, Args... args) {
  return call_real<Tag>(args...);
}

inline std::uint32_t mappable_type = 0;  // of the real device

/// Split memory: both types are the first one that the host sees.
inline VkResult make_call(vkAllocateMemoryTag, VkDevice device, const VkMemoryAllocateInfo* info,
                          const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  VulkanInterposer& self = VulkanInterposer::get();
  VkMemoryAllocateInfo real = *info;
  if (self.profile().split_memory) real.memoryTypeIndex = mappable_type;
  if (const auto& most = self.profile().max_allocation_bytes)
    check(self, "bytes of an allocation", info->allocationSize, *most);
  return call_real<vkAllocateMemoryTag>(device, static_cast<const VkMemoryAllocateInfo*>(&real), callbacks, memory);
}

/// The real device has the first family only.
inline VkResult make_call(vkCreateDeviceTag, VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                          const VkAllocationCallbacks* callbacks, VkDevice* device) {
  VkDeviceCreateInfo real = *info;
  if (VulkanInterposer::get().profile().copying_queue) real.queueCreateInfoCount = 1;
  return call_real<vkCreateDeviceTag>(physical, static_cast<const VkDeviceCreateInfo*>(&real), callbacks, device);
}

inline VkResult make_call(vkCreateCommandPoolTag, VkDevice device, const VkCommandPoolCreateInfo* info,
                          const VkAllocationCallbacks* callbacks, VkCommandPool* pool) {
  VkCommandPoolCreateInfo real = *info;
  if (real.queueFamilyIndex == TwoQueues::kCopyingFamily) real.queueFamilyIndex = 0;
  return call_real<vkCreateCommandPoolTag>(device, static_cast<const VkCommandPoolCreateInfo*>(&real), callbacks, pool);
}

inline VkResult make_call(vkCreateBufferTag, VkDevice device, const VkBufferCreateInfo* info,
                          const VkAllocationCallbacks* callbacks, VkBuffer* buffer) {
  VkBufferCreateInfo real = *info;
  VulkanInterposer& self = VulkanInterposer::get();
  const bool is_shared = info->sharingMode == VK_SHARING_MODE_CONCURRENT && info->queueFamilyIndexCount == 2;
  if (is_shared != self.profile().copying_queue.has_value())
    self.violation("the sharing of a buffer among queue families does not fit its use");
  real.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  return call_real<vkCreateBufferTag>(device, static_cast<const VkBufferCreateInfo*>(&real), callbacks, buffer);
}

inline VkResult make_call(vkQueueSubmitTag, VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                          VkFence fence) {
  VulkanInterposer& self = VulkanInterposer::get();
  const std::optional<LateQueue> late = self.profile().copying_queue;
  if (!late) return call_real<vkQueueSubmitTag>(queue, count, infos, fence);
  const auto real = [&self](const VkSubmitInfo& info, VkFence signalled) {
    return call_real<vkQueueSubmitTag>(self.queue, std::uint32_t{1}, &info, signalled);
  };
  return self.two_queues.submit(queue, *infos, fence, *late, real,
                                [&self](std::string what) { self.violation(std::move(what)); });
}

// Work for which a call waits must run in the end.
template <class... Args>
void let_run(VulkanInterposer& self, vkDeviceWaitIdleTag, Args...) {
  self.two_queues.run_until({});
}
inline void let_run(VulkanInterposer& self, vkWaitForFencesTag, VkDevice, std::uint32_t count, const VkFence* fences,
                    VkBool32, std::uint64_t) {
  for (std::uint32_t i = 0; i < count; ++i) self.two_queues.run_until(fences[i]);
}

inline VkResult enumerate(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* devices) {
  const InDriver inside;
  VulkanInterposer& self = VulkanInterposer::get();
  const VkResult fault = self.next_result("vkEnumeratePhysicalDevices", vkEnumeratePhysicalDevicesTag::kFaults);
  if (fault != VK_SUCCESS) return fault;
  if (self.profile().no_devices) {
    *count = 0;
    return VK_SUCCESS;
  }
  const VkResult result = call_real<vkEnumeratePhysicalDevicesTag>(instance, count, devices);
  return self.profile().never_complete && devices != nullptr ? VK_INCOMPLETE : result;
}

inline void change(VkPhysicalDeviceProperties& properties) {
  VulkanInterposer& self = VulkanInterposer::get();
  const DeviceProfile& profile = self.profile();
  if (profile.api_version != 0) properties.apiVersion = profile.api_version;
  if (profile.limits) profile.limits(properties.limits);
  self.limits = properties.limits;
}

inline void get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDevicePropertiesTag>(device, properties);
  change(*properties);
}

inline void get_properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceProperties2Tag>(device, properties);
  change(properties->properties);
  const DeviceProfile& profile = VulkanInterposer::get().profile();
  for (auto* next = static_cast<VkBaseOutStructure*>(properties->pNext); next != nullptr; next = next->pNext) {
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES && profile.no_subgroup_operations) {
      auto* subgroup = reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
      subgroup->subgroupSize = 1;
      subgroup->supportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
      subgroup->supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
      subgroup->quadOperationsInAllStages = VK_FALSE;
    }
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES && profile.max_allocation_bytes) {
      reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(next)->maxMemoryAllocationSize =
          *profile.max_allocation_bytes;
    }
  }
}

inline void get_families(VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* families) {
  const InDriver inside;
  const DeviceProfile& profile = VulkanInterposer::get().profile();
  const std::uint32_t room = *count, more = profile.copying_queue ? 1 : 0;
  std::uint32_t real = families != nullptr ? room - more : 0;
  call_real<vkGetPhysicalDeviceQueueFamilyPropertiesTag>(device, &real, families);
  *count = real + more;
  for (std::uint32_t i = 0; families != nullptr && i < real; ++i) {
    if (profile.no_compute) families[i].queueFlags &= ~static_cast<VkQueueFlags>(VK_QUEUE_COMPUTE_BIT);
    if (profile.no_graphics) families[i].queueFlags &= ~static_cast<VkQueueFlags>(VK_QUEUE_GRAPHICS_BIT);
    if (profile.timestamp_valid_bits) families[i].timestampValidBits = *profile.timestamp_valid_bits;
  }
  if (families != nullptr && more != 0)
    families[real] = {.queueFlags = VK_QUEUE_TRANSFER_BIT,
                      .queueCount = 1,
                      .timestampValidBits = 0,
                      .minImageTransferGranularity = {1, 1, 1}};
}

inline void get_queue(VkDevice device, std::uint32_t family, std::uint32_t index, VkQueue* queue) {
  const InDriver inside;
  if (family == TwoQueues::kCopyingFamily) {
    *queue = TwoQueues::copying_queue();
    return;
  }
  call_real<vkGetDeviceQueueTag>(device, family, index, queue);
  VulkanInterposer::get().queue = *queue;
}

inline void get_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceMemoryPropertiesTag>(device, memory);
  if (!VulkanInterposer::get().profile().split_memory) return;
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  mappable_type = 0;
  while ((memory->memoryTypes[mappable_type].propertyFlags & kMappable) != kMappable) ++mappable_type;
  const std::uint32_t heap = memory->memoryTypes[mappable_type].heapIndex;
  memory->memoryTypeCount = 2;
  memory->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, heap};
  memory->memoryTypes[1] = {kMappable, heap};
}

inline void get_format(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceFormatPropertiesTag>(device, format, properties);
  if (format == VulkanInterposer::get().profile().missing_format) properties->optimalTilingFeatures = 0;
}

inline void get_requirements(VkDevice device, const VkBufferMemoryRequirementsInfo2* info, VkMemoryRequirements2* out) {
  const InDriver inside;
  call_real<vkGetBufferMemoryRequirements2Tag>(device, info, out);
  if (VulkanInterposer::get().profile().split_memory) out->memoryRequirements.memoryTypeBits = 3;
}

}  // namespace medial_vk::test::hooks
