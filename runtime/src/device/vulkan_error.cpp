#include <string>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

const char* meaning(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "memory could not be mapped";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "a layer is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no compatible driver";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_FRAGMENTED_POOL:
      return "the pool is fragmented";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "the pool is exhausted";
    case VK_ERROR_INVALID_SHADER_NV:
      return "the driver refuses the shader";
    default:
      return nullptr;
  }
}

}  // namespace

Error vulkan_error(const char* call, VkResult result) {
  const bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const char* text = meaning(result);
  return {memory ? ErrorCode::kOutOfMemory : ErrorCode::kInternal,
          std::string(call) + " failed: " + (text != nullptr ? text : "VkResult " + std::to_string(result))};
}

}  // namespace medial_vk
