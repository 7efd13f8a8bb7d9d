// A Vulkan device that another program owns, a renderer say: the runtime computes on it and leaves it as it was.
//
//   device_requirements()  before the device is created: what to ask for
//   check_device()         before the device is created: will this one do?
//   Context::adopt()       after it: a context on it
//   extraction_job.h       records extractions into the host's command buffers
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What an instance and a device must be created with. Today that is the core of Vulkan 1.2 and nothing else; hosts
/// that add what is listed here will do with later versions too.
struct DeviceRequirements {
  std::uint32_t api_version = VK_API_VERSION_1_2;  ///< At least: VkApplicationInfo::apiVersion.
  std::vector<const char*> instance_extensions;
  std::vector<const char*> device_extensions;
  VkPhysicalDeviceFeatures features{};
};
DeviceRequirements device_requirements();

/// The host's Vulkan. All of it outlives the context.
struct HostDevice {
  /// Of the host's loader; null: that of libvulkan.so.1.
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  /// Of a family with compute. The context submits to it only in calls that block (create() of a scene or a job,
  /// queries, extract_medial_spheres()): the host does not use it during those.
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::uint32_t api_version = VK_API_VERSION_1_2;  ///< That the instance was created for.
  VkPhysicalDeviceFeatures enabled_features{};     ///< That the device was created with.
  /// For all objects that the context makes; null: the driver's own. Called from several threads at once.
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
  std::string cache_folder;  ///< As in ContextOptions.
  unsigned threads = 0;      ///< As in ContextOptions.
};

/// Whether a device that is created like this will do; `device` and `queue` are not looked at and may be null.
/// Error: kNoDevice, which says why not.
Status check_device(const HostDevice& host);

}  // namespace medial_vk
