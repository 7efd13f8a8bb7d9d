#include <volk.h>

#include "base/host_memory.h"
#include "medial_vk/host_device.h"

#include <array>
#include <cstring>
#include <mutex>
#include <new>

#include "device/context_impl.h"
#include "device/device_selection.h"
#include "device/instance.h"

namespace medial_vk {
namespace {

using FeatureFlags = std::array<VkBool32, sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32)>;

Error not_usable(const std::string& why) { return {ErrorCode::kNoDevice, "the host's device cannot be used: " + why}; }

FeatureFlags flags_of(const VkPhysicalDeviceFeatures& features) {
  FeatureFlags flags;
  std::memcpy(flags.data(), &features, sizeof(flags));
  return flags;
}

bool covers(const VkPhysicalDeviceFeatures& enabled, const VkPhysicalDeviceFeatures& needed) {
  const FeatureFlags have = flags_of(enabled), want = flags_of(needed);
  for (std::size_t i = 0; i < want.size(); ++i)
    if (want[i] != VK_FALSE && have[i] == VK_FALSE) return false;
  return true;
}

/// Preconditions: volk_mutex() is held, volk is loaded for the host's instance.
Result<PhysicalDevice> describe_host_device(const HostDevice& host) {
  const DeviceRequirements needs = device_requirements();
  if (host.api_version < needs.api_version) return not_usable("its instance is older than Vulkan 1.2");
  if (!covers(host.enabled_features, needs.features)) return not_usable("a feature that is needed is not enabled");
  PhysicalDevice device = describe_device(host.physical_device, host.queue_family);
  if (!device.description.usable) return not_usable(reasons_text(device.description));
  return device;
}

Status check_handles(const HostDevice& host) {
  if (host.instance == VK_NULL_HANDLE || host.physical_device == VK_NULL_HANDLE)
    return not_usable("its instance or its physical device is null");
  return {};
}

}  // namespace

DeviceRequirements device_requirements() { return {}; }

Status check_device(const HostDevice& host) try {
  if (Status status = check_handles(host); !status.ok()) return status;
  const std::lock_guard lock(volk_mutex());
  const Result<HostInstance> instance = HostInstance::load(host.get_instance_proc_addr, host.instance);
  if (!instance.ok()) return instance.error();
  const Result<PhysicalDevice> device = describe_host_device(host);
  if (!device.ok()) return device.error();
  return {};
} catch (const std::bad_alloc&) {
  return out_of_memory("testing a Vulkan device");
}

Status Context::Impl::adopt(const HostDevice& host) {
  if (Status status = check_handles(host); !status.ok()) return status;
  if (host.device == VK_NULL_HANDLE || host.queue == VK_NULL_HANDLE) return not_usable("it or its queue is null");
  owns_device_ = false;
  allocation_callbacks = host.allocation_callbacks;
  host_threads = host.threads;
  programs_progress = host.programs_progress;
  {
    const std::lock_guard lock(volk_mutex());
    const Result<HostInstance> loaded = HostInstance::load(host.get_instance_proc_addr, host.instance);
    if (!loaded.ok()) return loaded.error();
    Result<PhysicalDevice> described = describe_host_device(host);
    if (!described.ok()) return described.error();
    instance = host.instance;
    physical_device = host.physical_device;
    queue_family = host.queue_family;
    timestamp_valid_bits = described.value().timestamp_valid_bits;
    description = std::move(described.value().description);
    query_properties();
    volkLoadDeviceTable(&vk, host.device);
  }
  device = host.device;
  queue = host.queue;
  return open_pipeline_cache(host.cache_folder);
}

Result<Context> Context::adopt(const HostDevice& host) try {
  auto impl = std::make_unique<Impl>();
  if (Status status = impl->adopt(host); !status.ok()) return status.error();
  return Context(std::move(impl));
} catch (const std::bad_alloc&) {
  return out_of_memory("adopting a Vulkan device");
}

}  // namespace medial_vk
