// Uses the Vulkan loader directly and medial-vk beside it; both must see the same devices.
#include <medial_vk/context.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdio>

int main() {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  std::uint32_t own_count = 0;
  if (vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS) {
    vkEnumeratePhysicalDevices(instance, &own_count, nullptr);
  }
  const auto devices = medial_vk::Context::list_devices();
  const std::size_t count = devices ? devices.value().size() : 0;
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
  std::printf("devices: %u by the loader, %zu by medial-vk\n", own_count, count);
  return own_count == count ? 0 : 1;
}
