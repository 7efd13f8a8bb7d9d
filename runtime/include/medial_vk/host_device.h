// A Vulkan device that another program owns, such as a renderer: the library computes on it and leaves it as it was.
//
//   device_requirements()  before the device is created: the version, extensions and features to request
//   check_device()         before the device is created: a test whether it will be usable
//   Context::adopt()       afterwards: a context on the device
//   extraction_job.h       records extractions into the host's command buffers
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/context.h"  // for Context::adopt()
#include "medial_vk/result.h"

namespace medial_vk {

/// The version, extensions and features that an instance and a device must be created with. At present only the core of
/// Vulkan 1.2 is required; hosts that request everything listed here are also compatible with later versions.
struct DeviceRequirements {
  std::uint32_t api_version = VK_API_VERSION_1_2;  ///< Least value of VkApplicationInfo::apiVersion.
  std::vector<const char*> instance_extensions;
  std::vector<const char*> device_extensions;
  VkPhysicalDeviceFeatures features{};
};
DeviceRequirements device_requirements();

/// The Vulkan objects of the host. All of them outlive the context.
struct HostDevice {
  /// The function of the host's loader; null: that of libvulkan.so.1.
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  /// A queue of a family with compute. The context submits to it only in calls that block (create() of a scene or a
  /// job, queries, extract_medial_spheres()); the host must not use it during those.
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::uint32_t api_version = VK_API_VERSION_1_2;  ///< The version that the instance was created for.
  VkPhysicalDeviceFeatures enabled_features{};     ///< The features that the device was created with.
  /// The source of host memory for all objects that the context creates; null: the default of the driver. It is called
  /// from several threads at once.
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
  std::string cache_folder;                      ///< As in ContextOptions.
  unsigned threads = 0;                          ///< As in ContextOptions.
  ProgramsProgress programs_progress = nullptr;  ///< As in ContextOptions.
};

/// Tests whether a device that is created with these properties is usable; `device` and `queue` are not read and may be
/// null. Error: kNoDevice (the message gives the reason).
Status check_device(const HostDevice& host);

}  // namespace medial_vk
