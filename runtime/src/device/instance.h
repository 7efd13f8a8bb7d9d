// Loading Vulkan, making an instance, and hearing what the validation layer has to say.
#pragma once

#include <volk.h>

#include <cstdint>
#include <mutex>

#include "medial_vk/result.h"

namespace medial_vk {

/// A VkInstance and, with validation, the messenger that counts what the layer reports.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  PFN_vkDestroyInstance destroy = nullptr;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger = nullptr;
};

/// volk keeps the loader's and the instance's functions in global pointers and rewrites them for every instance.
/// Whoever creates, uses or destroys an instance holds this lock; device calls need no lock, they have a table each.
std::mutex& volk_mutex();

/// Precondition: volk_mutex() is held. With `validation`, `*message_count` counts the layer's warnings and errors
/// until the instance is destroyed, so its address must stay valid.
/// Errors: kNoDevice (no loader, no driver, Vulkan too old, layer not installed), kOutOfMemory.
Result<Instance> create_instance(bool validation, std::uint64_t* message_count,
                                 const VkAllocationCallbacks* allocation_callbacks);

/// Precondition: volk_mutex() is held; the instance's devices are gone. Does nothing to an empty Instance.
void destroy_instance(Instance& instance, const VkAllocationCallbacks* allocation_callbacks);

/// While it is there, volk is loaded for an instance of the host's. Precondition: volk_mutex() is held.
class HostInstance {
 public:
  /// `get` is the host's vkGetInstanceProcAddr, or null. Error: kNoDevice (no loader).
  static Result<HostInstance> load(PFN_vkGetInstanceProcAddr get, VkInstance instance);
  HostInstance(HostInstance&& other) noexcept;
  HostInstance& operator=(HostInstance&&) = delete;
  ~HostInstance();

 private:
  HostInstance() = default;
  bool restores_ = false;
  PFN_vkGetInstanceProcAddr before_ = nullptr;  // what volk used before, or null
};

}  // namespace medial_vk
