// What the rest of the runtime sees of a Vulkan device: the dispatch table, limits and a cache of programs.
#pragma once

#include <volk.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "program.h"

namespace medial_vk {

class Context::Impl {
 public:
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();

  VolkDeviceTable vk{};  // every device call goes through here, never through volk's globals
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  const VkAllocationCallbacks* allocation_callbacks = nullptr;

  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  VkPhysicalDeviceSubgroupProperties subgroup{};
  std::uint32_t timestamp_valid_bits = 0;  // 0: the queue has no timestamps
  DeviceDescription description;
  std::uint64_t validation_messages = 0;

  /// The program for this shader and these specialization constants; made once, kept until the context ends.
  /// Errors: kInternal (unknown shader, the driver refuses it), kOutOfMemory.
  Result<const Program*> program(const ProgramKey& key);

 private:
  friend class Context;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
  std::string pipeline_cache_file_;
  std::map<ProgramKey, std::unique_ptr<Program>> programs_;
};

/// "vkCreateBuffer failed: out of device memory"; kOutOfMemory for the two memory results, else kInternal.
Error vulkan_error(const char* call, VkResult result);

}  // namespace medial_vk
