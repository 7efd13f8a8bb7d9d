#include "device/instance.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

constexpr char kValidationLayer[] = "VK_LAYER_KHRONOS_validation";

Status load_vulkan() {
  // volk reports success of dlopen in vkGetInstanceProcAddr; once loaded there is no need to open it again.
  if (vkGetInstanceProcAddr == nullptr && volkInitialize() != VK_SUCCESS) {
    return Error{ErrorCode::kNoDevice,
                 "no Vulkan loader found (libvulkan.so.1); install libvulkan1 and a driver such as "
                 "mesa-vulkan-drivers"};
  }
  if (vkCreateInstance == nullptr) {
    return Error{ErrorCode::kNoDevice, "the Vulkan loader (libvulkan.so.1) has no vkCreateInstance: it is broken"};
  }
  const std::uint32_t version = volkGetInstanceVersion();
  if (version < VK_API_VERSION_1_2) {
    return Error{ErrorCode::kNoDevice, "the Vulkan loader is version " + std::to_string(VK_API_VERSION_MAJOR(version)) +
                                           "." + std::to_string(VK_API_VERSION_MINOR(version)) + "; 1.2 is needed"};
  }
  return {};
}

bool has_validation_layer() {
  std::uint32_t count = 0;
  if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkLayerProperties> layers(count);
  if (vkEnumerateInstanceLayerProperties(&count, layers.data()) < VK_SUCCESS) return false;
  layers.resize(count);
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* message_count) {
  // Layers may report from any thread that calls Vulkan.
  std::atomic_ref<std::uint64_t>(*static_cast<std::uint64_t*>(message_count)).fetch_add(1, std::memory_order_relaxed);
  const bool is_error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
  std::fprintf(stderr, "Vulkan validation %s: %s\n", is_error ? "error" : "warning",
               data->pMessage != nullptr ? data->pMessage : "(no text)");
  return VK_FALSE;  // never make the call itself fail: behave as without the layer
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::uint64_t* message_count) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not the GENERAL type: there the loader and the drivers report on the machine (a manifest that does not parse, a
  // driver without conformance), which does not concern the library's use of Vulkan and would fail tests at random.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = message_count;
  return info;
}

Error instance_error(VkResult result) {
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return {ErrorCode::kNoDevice, "no Vulkan driver found; install one, such as mesa-vulkan-drivers"};
  }
  Error error = vulkan_error("vkCreateInstance", result);
  if (error.code != ErrorCode::kOutOfMemory) error.code = ErrorCode::kNoDevice;
  return error;
}

Status add_messenger(Instance& instance, const VkDebugUtilsMessengerCreateInfoEXT& info,
                     const VkAllocationCallbacks* allocation_callbacks) {
  // Not volk's global pointers: they become null when an instance without the extension is made after this one.
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance.handle, "vkCreateDebugUtilsMessengerEXT"));
  instance.destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance.handle, "vkDestroyDebugUtilsMessengerEXT"));
  if (create == nullptr || instance.destroy_messenger == nullptr) {
    return Error{ErrorCode::kNoDevice, "the validation layer lacks VK_EXT_debug_utils"};
  }
  const VkResult result = create(instance.handle, &info, allocation_callbacks, &instance.messenger);
  if (result != VK_SUCCESS) return vulkan_error("vkCreateDebugUtilsMessengerEXT", result);
  return {};
}

}  // namespace

std::mutex& volk_mutex() {
  static std::mutex mutex;
  return mutex;
}

Result<Instance> create_instance(bool validation, std::uint64_t* message_count,
                                 const VkAllocationCallbacks* allocation_callbacks) {
  if (const Status loaded = load_vulkan(); !loaded.ok()) return loaded.error();
  if (validation && !has_validation_layer()) {
    return Error{ErrorCode::kNoDevice, std::string("`validation` requires the layer ") + kValidationLayer +
                                           "; install vulkan-validationlayers"};
  }

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "medial-vk";
  application.apiVersion = VK_API_VERSION_1_2;

  // The messenger in the chain also receives the messages about vkCreateInstance and vkDestroyInstance.
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(message_count);
  const std::array enabled = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size());
  features.pEnabledValidationFeatures = enabled.data();

  const std::array layers = {kValidationLayer};
  const std::array extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (validation) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
  }

  Instance instance;
  const VkResult result = vkCreateInstance(&info, allocation_callbacks, &instance.handle);
  if (result != VK_SUCCESS) return instance_error(result);
  volkLoadInstanceOnly(instance.handle);
  instance.destroy = vkDestroyInstance;  // volk's pointer changes with another instance
  if (validation) {
    if (const Status added = add_messenger(instance, messenger, allocation_callbacks); !added.ok()) {
      destroy_instance(instance, allocation_callbacks);
      return added.error();
    }
  }
  return instance;
}

void destroy_instance(Instance& instance, const VkAllocationCallbacks* allocation_callbacks) {
  if (instance.handle == VK_NULL_HANDLE) return;
  if (instance.messenger != VK_NULL_HANDLE) {
    instance.destroy_messenger(instance.handle, instance.messenger, allocation_callbacks);
  }
  instance.destroy(instance.handle, allocation_callbacks);
  instance = {};
}

Result<HostInstance> HostInstance::load(PFN_vkGetInstanceProcAddr get, VkInstance instance) {
  HostInstance loaded;
  if (get != nullptr) {
    loaded.before_ = vkGetInstanceProcAddr;
    loaded.restores_ = true;
    volkInitializeCustom(get);
  } else if (const Status status = load_vulkan(); !status.ok()) {
    return status.error();
  }
  volkLoadInstanceOnly(instance);
  return loaded;
}

HostInstance::HostInstance(HostInstance&& other) noexcept
    : restores_(std::exchange(other.restores_, false)), before_(other.before_) {}

HostInstance::~HostInstance() {
  if (!restores_) return;
  // No pointer to the host's loader remains: it may be unloaded before the next use of volk.
  if (before_ != nullptr)
    volkInitializeCustom(before_);
  else
    vkGetInstanceProcAddr = nullptr;
}

}  // namespace medial_vk
