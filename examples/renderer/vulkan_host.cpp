#include "vulkan_host.h"

#include <medial_vk/host_device.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool has_validation_layer() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [](const VkLayerProperties& l) { return std::strcmp(l.layerName, kValidationLayer) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* count) {
  ++*static_cast<std::atomic<unsigned>*>(count);
  std::fprintf(stderr, "validation: %s\n", data->pMessage);
  return VK_FALSE;
}

template <class Function>
Function instance_function(VkInstance instance, const char* name) {
  const auto function = reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
  if (function == nullptr) fail(name);
  return function;
}

}  // namespace

void fail(const char* what) {
  std::fprintf(stderr, "renderer: %s\n", what);
  std::exit(1);
}

void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) fail(call);
}

VulkanHost::VulkanHost() {
  create_instance();
  create_device();
}

VulkanHost::~VulkanHost() {
  vkDestroyDevice(device, nullptr);
  if (validates())
    instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT")(
        instance, messenger_, nullptr);
  vkDestroyInstance(instance, nullptr);
}

void VulkanHost::create_instance() {
  auto application = vulkan_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.apiVersion = medial_vk::device_requirements().api_version;
  auto messenger =
      vulkan_struct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = on_message;
  messenger.pUserData = &messages_;
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  auto validation = vulkan_struct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger);
  validation.enabledValidationFeatureCount = 1;
  validation.pEnabledValidationFeatures = &synchronization;
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};

  auto info = vulkan_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  const bool validates = has_validation_layer();
  if (validates) {
    info.pNext = &validation;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 2;
    info.ppEnabledExtensionNames = extensions;
  }
  check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  if (!validates) return;
  const auto create = instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT");
  check(create(instance, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

// The first device and family that draw, and that medial-vk supports for computation.
void VulkanHost::create_device() {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance, &count, devices.data());
  bool found = false;
  for (std::size_t i = 0; i < devices.size() && !found; ++i) {
    std::uint32_t families = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(devices[i], &families, nullptr);
    std::vector<VkQueueFamilyProperties> properties(families);
    vkGetPhysicalDeviceQueueFamilyProperties(devices[i], &families, properties.data());
    for (std::uint32_t family = 0; family < families && !found; ++family) {
      medial_vk::HostDevice candidate;
      candidate.get_instance_proc_addr = vkGetInstanceProcAddr;
      candidate.instance = instance;
      candidate.physical_device = devices[i];
      candidate.queue_family = family;
      if ((properties[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0 || !medial_vk::check_device(candidate)) continue;
      physical_device = devices[i];
      queue_family = family;
      found = true;
    }
  }
  if (!found) fail("no device that draws and computes");

  const medial_vk::DeviceRequirements needs = medial_vk::device_requirements();
  features = needs.features;
  const float priority = 1;
  auto queue_info = vulkan_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue_info.queueFamilyIndex = queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  auto info = vulkan_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  info.enabledExtensionCount = static_cast<std::uint32_t>(needs.device_extensions.size());
  info.ppEnabledExtensionNames = needs.device_extensions.data();
  info.pEnabledFeatures = &features;
  check(vkCreateDevice(physical_device, &info, nullptr, &device), "vkCreateDevice");
  vkGetDeviceQueue(device, queue_family, 0, &queue);
}

VkDeviceMemory VulkanHost::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) const {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
  for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if ((needs.memoryTypeBits >> type & 1u) == 0) continue;
    if ((memory.memoryTypes[type].propertyFlags & properties) != properties) continue;
    auto info = vulkan_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory allocated = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &info, nullptr, &allocated), "vkAllocateMemory");
    return allocated;
  }
  fail("no suitable memory");
}

HostBuffer VulkanHost::create_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) const {
  HostBuffer made;
  auto info = vulkan_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = usage;
  check(vkCreateBuffer(device, &info, nullptr, &made.handle), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, made.handle, &needs);
  made.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device, made.handle, made.memory, 0), "vkBindBufferMemory");
  check(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
  return made;
}

HostImage VulkanHost::create_image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage,
                                   VkImageAspectFlags aspect) const {
  HostImage made;
  auto info = vulkan_struct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.width, size.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vkCreateImage(device, &info, nullptr, &made.handle), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, made.handle, &needs);
  made.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device, made.handle, made.memory, 0), "vkBindImageMemory");
  auto view = vulkan_struct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = made.handle;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  check(vkCreateImageView(device, &view, nullptr, &made.view), "vkCreateImageView");
  return made;
}

void VulkanHost::destroy(HostBuffer& buffer) const {
  vkDestroyBuffer(device, buffer.handle, nullptr);
  vkFreeMemory(device, buffer.memory, nullptr);
}

void VulkanHost::destroy(HostImage& image) const {
  vkDestroyImageView(device, image.view, nullptr);
  vkDestroyImage(device, image.handle, nullptr);
  vkFreeMemory(device, image.memory, nullptr);
}
