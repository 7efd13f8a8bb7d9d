// The loader of Vulkan, an instance, and the messages of the validation layer.
#pragma once

#include <volk.h>

#include <cstdint>
#include <mutex>

#include "medial_vk/result.h"

namespace medial_vk {

/// A VkInstance and, with validation, the messenger that counts the reports of the layer.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  PFN_vkDestroyInstance destroy = nullptr;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger = nullptr;
};

/// volk keeps the loader's and the instance's functions in global pointers and rewrites them for every instance.
/// Code that creates, uses or destroys an instance must hold this lock; device calls need none, as each device has its
/// own table.
std::mutex& volk_mutex();

/// Precondition: volk_mutex() is held. With `validation`, `*message_count` counts the layer's warnings and errors
/// until the instance is destroyed, so its address must stay valid.
/// Errors: kNoDevice (no loader, no driver, Vulkan too old, layer not installed), kOutOfMemory.
Result<Instance> create_instance(bool validation, std::uint64_t* message_count,
                                 const VkAllocationCallbacks* allocation_callbacks);

/// Precondition: volk_mutex() is held; the instance's devices are destroyed. Does nothing to an empty Instance.
void destroy_instance(Instance& instance, const VkAllocationCallbacks* allocation_callbacks);

/// During its lifetime, volk is loaded for an instance of the host. Precondition: volk_mutex() is held.
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
  PFN_vkGetInstanceProcAddr before_ = nullptr;  // the previous function of volk, or null
};

}  // namespace medial_vk
