// The Vulkan objects of the renderer: instance with validation if the layer is installed, device, one queue that draws
// and computes, and buffers and images with a memory block each. Errors end the program, since it is an example.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>

template <class T>
T vulkan_struct(VkStructureType type, const void* next = nullptr) {
  T made{};
  made.sType = type;
  made.pNext = const_cast<void*>(next);
  return made;
}

[[noreturn]] void fail(const char* what);
void check(VkResult result, const char* call);

struct HostBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};

struct HostImage {
  VkImage handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

class VulkanHost {
 public:
  VulkanHost();
  VulkanHost(const VulkanHost&) = delete;
  VulkanHost& operator=(const VulkanHost&) = delete;
  ~VulkanHost();

  HostBuffer create_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) const;  // visible to the host, coherent
  HostImage create_image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) const;
  void destroy(HostBuffer& buffer) const;
  void destroy(HostImage& image) const;

  bool validates() const { return messenger_ != VK_NULL_HANDLE; }
  unsigned validation_messages() const { return messages_; }

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  VkPhysicalDeviceFeatures features{};  // as enabled

 private:
  void create_instance();
  void create_device();
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) const;

  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::atomic<unsigned> messages_ = 0;
};
