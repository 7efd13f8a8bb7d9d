#include "medial_vk/context.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>
#include <utility>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device/device_selection.h"
#include "device/instance.h"
#include "device/pipeline_cache.h"

namespace medial_vk {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

Result<PhysicalDevice> select_device(VkInstance instance, const std::string& device_option) {
  Result<std::vector<PhysicalDevice>> devices = enumerate_devices(instance);
  if (!devices.ok()) return devices.error();
  std::vector<DeviceDescription> descriptions;
  for (const PhysicalDevice& device : devices.value()) descriptions.push_back(device.description);

  const Result<std::uint32_t> chosen = Context::choose_device(descriptions, device_option);
  if (!chosen.ok()) return chosen.error();
  return devices.value()[chosen.value()];
}

}  // namespace

Status Context::Impl::initialize(const ContextOptions& options) {
  allocation_callbacks = options.allocation_callbacks;
  host_threads = options.threads;
  programs_progress = options.programs_progress;
  {
    const std::lock_guard lock(volk_mutex());
    Result<Instance> created = create_instance(options.validation, &validation_messages, allocation_callbacks);
    if (!created.ok()) return created.error();
    instance_ = created.value();
    instance = instance_.handle;

    Result<PhysicalDevice> selected = select_device(instance, options.device);
    if (!selected.ok()) return selected.error();
    physical_device = selected.value().handle;
    queue_family = selected.value().queue_family;
    timestamp_valid_bits = selected.value().timestamp_valid_bits;
    description = std::move(selected.value().description);
    query_properties();
    if (Status made = create_device(selected.value().transfer_family); !made.ok()) return made;
  }
  return open_pipeline_cache(options.cache_folder);
}

void Context::Impl::query_properties() {
  VkPhysicalDeviceIDProperties identity{};
  identity.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
  VkPhysicalDeviceMaintenance3Properties maintenance{};
  maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  maintenance.pNext = &identity;
  VkPhysicalDeviceDriverProperties driver_properties{};
  driver_properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  identity.pNext = &driver_properties;
  subgroup = {};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  subgroup.pNext = &maintenance;
  VkPhysicalDeviceProperties2 query{};
  query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  query.pNext = &subgroup;
  vkGetPhysicalDeviceProperties2(physical_device, &query);
  subgroup.pNext = nullptr;  // the chain was on this stack frame

  limits = query.properties.limits;
  is_llvmpipe = driver_properties.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
  dispatch_threads = is_llvmpipe ? std::max(1u, std::thread::hardware_concurrency()) : 1;
  has_lockstep_lanes = is_llvmpipe && subgroup.subgroupSize % 8 == 0 &&
                       (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT) != 0;
  max_allocation_bytes = maintenance.maxMemoryAllocationSize;
  vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
  pipeline_cache_identity_ = {.vendor = query.properties.vendorID, .device = query.properties.deviceID};
  std::copy_n(identity.driverUUID, VK_UUID_SIZE, pipeline_cache_identity_.driver_uuid.begin());
  std::copy_n(query.properties.pipelineCacheUUID, VK_UUID_SIZE, pipeline_cache_identity_.cache_uuid.begin());
}

Status Context::Impl::create_device(std::optional<std::uint32_t> copying_family) {
  const float priority = 1.0f;
  std::array<VkDeviceQueueCreateInfo, 2> queue_infos{};
  for (VkDeviceQueueCreateInfo& queue_info : queue_infos) {
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = queue_family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
  }
  if (copying_family) queue_infos[1].queueFamilyIndex = *copying_family;
  // No features and no extensions: the kernels use nothing beyond the core of Vulkan 1.2.
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = copying_family ? 2 : 1;
  info.pQueueCreateInfos = queue_infos.data();
  const VkResult result = vkCreateDevice(physical_device, &info, allocation_callbacks, &device);
  if (result != VK_SUCCESS) {
    device = VK_NULL_HANDLE;
    Error error = vulkan_error("vkCreateDevice", result);
    if (error.code != ErrorCode::kOutOfMemory) error.code = ErrorCode::kNoDevice;
    error.message += " (" + description.name + ")";
    return error;
  }
  volkLoadDeviceTable(&vk, device);
  vk.vkGetDeviceQueue(device, queue_family, 0, &queue);
  if (copying_family) {
    transfer_family = *copying_family;
    vk.vkGetDeviceQueue(device, transfer_family, 0, &transfer_queue);
  }
  return {};
}

Context::Impl::~Impl() {
  if (device != VK_NULL_HANDLE) {
    if (owns_device_) vk.vkDeviceWaitIdle(device);
    close_programs();
    vk.vkDestroyPipelineCache(device, pipeline_cache_, allocation_callbacks);
    if (owns_device_) vk.vkDestroyDevice(device, allocation_callbacks);
  }
  const std::lock_guard lock(volk_mutex());
  destroy_instance(instance_, allocation_callbacks);
}

Context::Context(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

void Context::close_programs() noexcept { impl_->close_programs(); }

Result<Context> Context::create(const ContextOptions& options) try {
  auto impl = std::make_unique<Impl>();
  if (Status status = impl->initialize(options); !status.ok()) return status.error();
  return Context(std::move(impl));
} catch (const std::bad_alloc&) {
  return out_of_memory("opening a Vulkan device");
}

Result<std::vector<DeviceDescription>> Context::list_devices() try {
  const std::lock_guard lock(volk_mutex());
  std::uint64_t no_messages = 0;
  Result<Instance> instance = create_instance(false, &no_messages, nullptr);
  if (!instance.ok()) return instance.error();
  // Also without host memory for the list.
  const auto destroy = [](Instance* made) { destroy_instance(*made, nullptr); };
  const std::unique_ptr<Instance, decltype(destroy)> owner(&instance.value(), destroy);
  Result<std::vector<PhysicalDevice>> devices = enumerate_devices(instance.value().handle);
  if (!devices.ok()) return devices.error();
  std::vector<DeviceDescription> descriptions;
  for (PhysicalDevice& device : devices.value()) descriptions.push_back(std::move(device.description));
  return descriptions;
} catch (const std::bad_alloc&) {
  return out_of_memory("listing Vulkan devices");
}

Result<std::uint32_t> Context::choose_device(std::span<const DeviceDescription> devices,
                                             const std::string& device) try {
  const bool by_option = !device.empty();
  return medial_vk::choose_device(devices, by_option ? device : environment("MEDIAL_VK_DEVICE"),
                                  by_option ? "`device`" : "MEDIAL_VK_DEVICE");
} catch (const std::bad_alloc&) {
  return out_of_memory("choosing a Vulkan device");
}

std::string Context::default_cache_folder() { return pipeline_cache_folder({}); }

const DeviceDescription& Context::device() const { return impl_->description; }

std::uint64_t Context::validation_messages() const {
  return std::atomic_ref<std::uint64_t>(impl_->validation_messages).load(std::memory_order_relaxed);
}

}  // namespace medial_vk
