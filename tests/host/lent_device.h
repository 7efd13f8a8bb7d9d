// The device of the renderer example, as a host lends it to the library.
#pragma once

#include <medial_vk/host_device.h>

#include "vulkan_host.h"

namespace medial_vk::test {

inline HostDevice lend(const VulkanHost& vulkan) {
  HostDevice host;
  host.get_instance_proc_addr = vkGetInstanceProcAddr;
  host.instance = vulkan.instance;
  host.physical_device = vulkan.physical_device;
  host.device = vulkan.device;
  host.queue = vulkan.queue;
  host.queue_family = vulkan.queue_family;
  host.enabled_features = vulkan.features;
  host.cache_folder = "/dev/null";
  return host;
}

}  // namespace medial_vk::test
