// The implementation that finds the medial spheres.
#pragma once

namespace medial_vk {

enum class Backend {
  kVulkan,  ///< A Vulkan device.
  kCpu,     ///< The CPU reference: double precision, one thread, no Vulkan.
};

}  // namespace medial_vk
