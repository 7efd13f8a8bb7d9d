// Uses its own volk, and medial-vk in between: the host's function pointers must survive.
#include <medial_vk/context.h>
#include <volk.h>

#include <cstdint>
#include <cstdio>

int main() {
  std::uint32_t own_count = 0;
  VkInstance instance = VK_NULL_HANDLE;
  if (volkInitialize() == VK_SUCCESS) {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS) volkLoadInstance(instance);
  }
  const auto devices = medial_vk::Context::list_devices();
  const std::size_t count = devices ? devices.value().size() : 0;
  if (instance != VK_NULL_HANDLE) {
    if (volkGetLoadedInstance() != instance) return 1;
    vkEnumeratePhysicalDevices(instance, &own_count, nullptr);
    vkDestroyInstance(instance, nullptr);
  }
  std::printf("devices: %u by the host, %zu by medial-vk\n", own_count, count);
  return own_count == count ? 0 : 1;
}
