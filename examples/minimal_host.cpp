// The smallest host with its own Vulkan device: it records an extraction into its command buffer, submits it with a
// timeline semaphore, and reads the spheres from the buffer of the job. Compute only; no window.
#include <medial_vk/extraction_job.h>
#include <medial_vk/host_device.h>
#include <vulkan/vulkan.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "minimal_host: %s\n", what);
  std::exit(1);
}
void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) fail(call);
}
void check(const medial_vk::Status& status) {
  if (!status) fail(status.error().message.c_str());
}
template <class T>
T vulkan_struct(VkStructureType type, const void* next = nullptr) {
  T made{};
  made.sType = type;
  made.pNext = const_cast<void*>(next);
  return made;
}
template <class T>
T take(medial_vk::Result<T> result) {
  if (!result) fail(result.error().message.c_str());
  return std::move(result).value();
}

VkInstance create_instance() {
  auto application = vulkan_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.apiVersion = medial_vk::device_requirements().api_version;
  auto info = vulkan_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  return instance;
}

// The first suitable device, with its first suitable queue family.
medial_vk::HostDevice create_device(VkInstance instance) {
  medial_vk::HostDevice host;
  host.get_instance_proc_addr = vkGetInstanceProcAddr;
  host.instance = instance;
  std::uint32_t count = 1;
  vkEnumeratePhysicalDevices(instance, &count, &host.physical_device);
  if (count == 0) fail("no Vulkan device");
  check(medial_vk::check_device(host));

  const float priority = 1;
  auto queue = vulkan_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = host.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto timeline = vulkan_struct<VkPhysicalDeviceTimelineSemaphoreFeatures>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES);
  timeline.timelineSemaphore = VK_TRUE;
  auto info = vulkan_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &timeline);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  check(vkCreateDevice(host.physical_device, &info, nullptr, &host.device), "vkCreateDevice");
  vkGetDeviceQueue(host.device, host.queue_family, 0, &host.queue);
  return host;
}

VkCommandBuffer begin_commands(VkDevice device, VkCommandPool pool) {
  auto allocation = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocation.commandPool = pool;
  allocation.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device, &allocation, &commands), "vkAllocateCommandBuffers");
  const auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  return commands;
}

// Submits the commands, and waits for the final value of the timeline.
void run(const medial_vk::HostDevice& host, VkCommandBuffer commands) {
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  auto type = vulkan_struct<VkSemaphoreTypeCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  const auto made = vulkan_struct<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type);
  VkSemaphore timeline = VK_NULL_HANDLE;
  check(vkCreateSemaphore(host.device, &made, nullptr, &timeline), "vkCreateSemaphore");
  const std::uint64_t done = 1;
  auto values = vulkan_struct<VkTimelineSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO);
  values.signalSemaphoreValueCount = 1;
  values.pSignalSemaphoreValues = &done;
  auto submit = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO, &values);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &timeline;
  check(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  auto wait = vulkan_struct<VkSemaphoreWaitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO);
  wait.semaphoreCount = 1;
  wait.pSemaphores = &timeline;
  wait.pValues = &done;
  check(vkWaitSemaphores(host.device, &wait, UINT64_MAX), "vkWaitSemaphores");
  vkDestroySemaphore(host.device, timeline, nullptr);
}

}  // namespace

int main() {
  // A box of 3 x 2 x 1. Triangles are counter-clockwise seen from outside; all normals can be trusted.
  const std::vector<medial_vk::Point> vertices = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0},
                                                  {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
  const std::vector<medial_vk::Triangle> triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const std::vector<std::uint8_t> flags(triangles.size(), medial_vk::kTrustedNormal);
  const medial_vk::MeshView mesh{vertices, triangles, flags, true};

  const VkInstance instance = create_instance();
  const medial_vk::HostDevice host = create_device(instance);
  VkCommandPool pool = VK_NULL_HANDLE;
  auto pool_info = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.queueFamilyIndex = host.queue_family;
  check(vkCreateCommandPool(host.device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
  {
    medial_vk::Context context = take(medial_vk::Context::adopt(host));
    medial_vk::ExtractionOptions options;
    options.resolution = 40;
    options.memory_budget = 256u << 20;
    const auto indexed = take(medial_vk::IndexedMesh::build(mesh));
    auto job = take(medial_vk::ExtractionJob::create(context, indexed, options));
    const VkCommandBuffer commands = begin_commands(host.device, pool);
    check(job.record(commands));
    run(host, commands);
    const medial_vk::RecordedCounts counts = job.counts();
    std::printf("%u medial spheres of a box, in a VkBuffer of %s\n", counts.spheres, context.device().name.c_str());
    if (counts.complete == 0 || counts.spheres == 0) fail("no spheres");
  }
  vkDestroyCommandPool(host.device, pool, nullptr);
  vkDestroyDevice(host.device, nullptr);
  vkDestroyInstance(instance, nullptr);
}
