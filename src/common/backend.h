// Who finds the medial spheres.
#pragma once

namespace medial_vk {

enum class Backend {
  kVulkan,  ///< A Vulkan device.
  kCpu,     ///< The CPU reference: double precision, one thread, no Vulkan at all.
};

}  // namespace medial_vk
