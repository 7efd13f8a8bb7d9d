#include "output/picture/vulkan/drawing_device.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <utility>

#include "platform/libraries.h"

namespace medial_vk::picture {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* count) {
  static_cast<std::atomic<std::uint64_t>*>(count)->fetch_add(1, std::memory_order_relaxed);
  std::fprintf(stderr, "Vulkan validation: %s\n", data->pMessage != nullptr ? data->pMessage : "(no text)");
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::atomic<std::uint64_t>* count) {
  auto info =
      vulkan_struct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = count;
  return info;
}

/// The library is never closed, because the runtime uses it too.
PFN_vkGetInstanceProcAddr load_vulkan() {
  std::string problem;
  void* const library = platform::load_vulkan(problem);
  if (library == nullptr) throw DrawingError("there is no Vulkan loader");
  const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(platform::function_of(library, "vkGetInstanceProcAddr"));
  if (get == nullptr) throw DrawingError("the Vulkan loader is broken");
  return get;
}

}  // namespace

void DrawingDevice::check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  throw DrawingError(fmt::format("{} failed: {}", call,
                                 result == VK_ERROR_OUT_OF_HOST_MEMORY     ? "out of host memory"
                                 : result == VK_ERROR_OUT_OF_DEVICE_MEMORY ? "out of device memory"
                                 : result == VK_ERROR_DEVICE_LOST          ? "device lost"
                                                                           : fmt::format("error {}", int{result})));
}

DrawingDevice::DrawingDevice(const DeviceDescription& description, bool validation, PFN_vkGetInstanceProcAddr loader) {
  try {
    get_instance_proc_addr_ = loader != nullptr ? loader : load_vulkan();
    create_instance(validation);
    physical_device_ = find(description);
    create_device(physical_device_);
  } catch (...) {
    destroy();  // the destructor of a partially constructed object is not called
    throw;
  }
}

DrawingDevice::~DrawingDevice() { destroy(); }

void DrawingDevice::destroy() {
  if (device != VK_NULL_HANDLE) {
    vk.DeviceWaitIdle(device);
    for (; !at_end_.empty(); at_end_.pop_back()) at_end_.back()();
    vk.DestroyDevice(device, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        get_instance_proc_addr_(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  }
  if (instance_functions_.DestroyInstance != nullptr) instance_functions_.DestroyInstance(instance_, nullptr);
}

void DrawingDevice::create_instance(bool validation) {
  auto application = vulkan_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "medial-vk";
  application.apiVersion = VK_API_VERSION_1_2;
  const auto messenger = messenger_info(&messages_);
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  auto features = vulkan_struct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  const std::array layers = {"VK_LAYER_KHRONOS_validation"};
  const std::array extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  auto info = vulkan_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  if (validation) {
    info.pNext = &features;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
  }
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get_instance_proc_addr_(nullptr, "vkCreateInstance"));
  if (create == nullptr) throw DrawingError("the Vulkan loader is broken");
  check(create(&info, nullptr, &instance_), "vkCreateInstance");
#define MEDIAL_VK_PICTURE_LOAD(name) \
  instance_functions_.name = reinterpret_cast<PFN_vk##name>(get_instance_proc_addr_(instance_, "vk" #name));
  MEDIAL_VK_PICTURE_INSTANCE_FUNCTIONS(MEDIAL_VK_PICTURE_LOAD)
#undef MEDIAL_VK_PICTURE_LOAD
  if (validation) add_messenger();
}

void DrawingDevice::add_messenger() {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      get_instance_proc_addr_(instance_, "vkCreateDebugUtilsMessengerEXT"));
  const auto info = messenger_info(&messages_);
  check(create(instance_, &info, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

VkPhysicalDevice DrawingDevice::find(const DeviceDescription& description) const {
  std::uint32_t count = 0;
  check(instance_functions_.EnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(instance_functions_.EnumeratePhysicalDevices(instance_, &count, devices.data()), "vkEnumeratePhysicalDevices");
  if (description.index >= devices.size()) throw DrawingError(description.name + " is gone");
  VkPhysicalDeviceProperties properties{};
  instance_functions_.GetPhysicalDeviceProperties(devices[description.index], &properties);
  if (description.name != properties.deviceName) throw DrawingError(description.name + " is gone");
  return devices[description.index];
}

void DrawingDevice::create_device(VkPhysicalDevice physical_device) {
  VkPhysicalDeviceProperties properties{};
  instance_functions_.GetPhysicalDeviceProperties(physical_device, &properties);
  limits = properties.limits;
  instance_functions_.GetPhysicalDeviceMemoryProperties(physical_device, &memory_);
  std::uint32_t count = 0;
  instance_functions_.GetPhysicalDeviceQueueFamilyProperties(physical_device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance_functions_.GetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families.data());
  for (queue_family = 0; queue_family < count; ++queue_family) {
    if ((families[queue_family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) break;
  }
  if (queue_family == count) throw DrawingError(fmt::format("{} has no graphics queue", properties.deviceName));

  const float priority = 1;
  auto queue_info = vulkan_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue_info.queueFamilyIndex = queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  auto info = vulkan_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  check(instance_functions_.CreateDevice(physical_device, &info, nullptr, &device), "vkCreateDevice");
#define MEDIAL_VK_PICTURE_LOAD(name) \
  vk.name = reinterpret_cast<PFN_vk##name>(instance_functions_.GetDeviceProcAddr(device, "vk" #name));
  MEDIAL_VK_PICTURE_DEVICE_FUNCTIONS(MEDIAL_VK_PICTURE_LOAD)
#undef MEDIAL_VK_PICTURE_LOAD
  vk.GetDeviceQueue(device, queue_family, 0, &queue);
}

/// Some devices do not support depth targets of 32 bits.
void DrawingDevice::check_format(VkFormat format, VkImageUsageFlags usage) const {
  constexpr std::array<std::pair<VkImageUsageFlags, VkFormatFeatureFlags>, 4> kNeeded = {
      {{VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT},
       {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT},
       {VK_IMAGE_USAGE_SAMPLED_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT},
       {VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_FORMAT_FEATURE_TRANSFER_SRC_BIT}}};
  VkFormatProperties properties{};
  instance_functions_.GetPhysicalDeviceFormatProperties(physical_device_, format, &properties);
  for (const auto& [use, feature] : kNeeded) {
    if ((usage & use) != 0 && (properties.optimalTilingFeatures & feature) == 0)
      throw DrawingError(fmt::format("the device does not draw with images of VkFormat {}", static_cast<int>(format)));
  }
}

VkDeviceMemory DrawingDevice::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
    if ((needs.memoryTypeBits >> type & 1u) == 0) continue;
    if ((memory_.memoryTypes[type].propertyFlags & wanted) != wanted) continue;
    auto info = vulkan_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vk.AllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
    at_end([this, memory] { vk.FreeMemory(device, memory, nullptr); });
    return memory;
  }
  throw DrawingError("the device has no suitable memory");
}

DrawingBuffer DrawingDevice::create_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) {
  DrawingBuffer made;
  made.bytes = bytes;
  auto info = vulkan_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = usage;
  check(vk.CreateBuffer(device, &info, nullptr, &made.handle), "vkCreateBuffer");
  at_end([this, handle = made.handle] { vk.DestroyBuffer(device, handle, nullptr); });
  VkMemoryRequirements needs;
  vk.GetBufferMemoryRequirements(device, made.handle, &needs);
  const VkDeviceMemory memory =
      allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vk.BindBufferMemory(device, made.handle, memory, 0), "vkBindBufferMemory");
  check(vk.MapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
  return made;
}

DrawingImage DrawingDevice::create_image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage,
                                         VkImageAspectFlags aspect) {
  check_format(format, usage);
  DrawingImage made;
  auto info = vulkan_struct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.width, size.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vk.CreateImage(device, &info, nullptr, &made.handle), "vkCreateImage");
  at_end([this, handle = made.handle] { vk.DestroyImage(device, handle, nullptr); });
  VkMemoryRequirements needs;
  vk.GetImageMemoryRequirements(device, made.handle, &needs);
  const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vk.BindImageMemory(device, made.handle, memory, 0), "vkBindImageMemory");
  auto view = vulkan_struct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = made.handle;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  check(vk.CreateImageView(device, &view, nullptr, &made.view), "vkCreateImageView");
  at_end([this, handle = made.view] { vk.DestroyImageView(device, handle, nullptr); });
  return made;
}

}  // namespace medial_vk::picture
