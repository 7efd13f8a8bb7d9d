// A Vulkan device that draws: its own instance, device and queue, and buffers and images with a memory block each.
// Inside this folder failures are thrown as DrawingError, which does not leave the folder (device_painter.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "output/picture/vulkan/functions.h"

namespace medial_vk::picture {

class DrawingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DrawingBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  void* mapped = nullptr;
  VkDeviceSize bytes = 0;
};

struct DrawingImage {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

class DrawingDevice {
 public:
  /// Opens the physical device of this description: the one with its index, which must have its name. `loader`:
  /// null for that of the system.
  DrawingDevice(const DeviceDescription& description, bool validation, PFN_vkGetInstanceProcAddr loader);
  DrawingDevice(const DrawingDevice&) = delete;
  DrawingDevice& operator=(const DrawingDevice&) = delete;
  ~DrawingDevice();

  DrawingBuffer create_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage);  // visible to the host, coherent
  DrawingImage create_image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);

  /// Registers an action to run before the device is destroyed, the last first.
  void at_end(std::function<void()> destroy) { at_end_.push_back(std::move(destroy)); }
  static void check(VkResult result, const char* call);

  std::uint64_t validation_messages() const { return messages_.load(std::memory_order_relaxed); }

  DeviceFunctions vk;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  VkPhysicalDeviceLimits limits{};

 private:
  void create_instance(bool validation);
  void add_messenger();
  VkPhysicalDevice find(const DeviceDescription& description) const;
  void create_device(VkPhysicalDevice physical_device);
  void check_format(VkFormat format, VkImageUsageFlags usage) const;
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted);
  void destroy();

  InstanceFunctions instance_functions_;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr_ = nullptr;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::atomic<std::uint64_t> messages_ = 0;  // written by the validation layer from any thread
  VkPhysicalDeviceMemoryProperties memory_{};
  std::vector<std::function<void()>> at_end_;
};

}  // namespace medial_vk::picture
