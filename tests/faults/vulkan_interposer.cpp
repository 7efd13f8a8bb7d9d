#include "vulkan_interposer.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "limit_checks.h"
#include "pretended_device.h"
#include "resources_used.h"
#include "vulkan_calls.h"

namespace medial_vk::test {
namespace hooks {
namespace {

unsigned mask_of(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return kHost;
    case Fault::kOutOfDeviceMemory:
      return kDevice;
    case Fault::kDeviceFull:
      return kAllocates;
    case Fault::kDeviceLost:
      return kLost;
    case Fault::kNone:
      break;
  }
  return 0;
}

VkResult result_of(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    case Fault::kDeviceLost:
      return VK_ERROR_DEVICE_LOST;
    default:
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
}

template <class Tag, class F>
struct Hook;

/// Calls that can fail.
template <class Tag, class... Args>
struct Hook<Tag, VkResult (*)(Args...)> {
  static VkResult call(Args... args) {
    const InDriver inside;
    VulkanInterposer& self = VulkanInterposer::get();
    const VkResult fault = self.next_result(Tag::kName, Tag::kFaults);
    constexpr bool kWaits = std::is_same_v<Tag, vkWaitForFencesTag> || std::is_same_v<Tag, vkDeviceWaitIdleTag>;
    if constexpr (kWaits) {
      let_run(self, Tag(), args...);
      if (fault == VK_ERROR_DEVICE_LOST) {  // no further work follows: let the real one finish first
        self.two_queues.run_until({});
        call_real<vkDeviceWaitIdleTag>(std::get<0>(std::make_tuple(args...)));
        self.work.finished({});
      }
    }
    if (fault != VK_SUCCESS) return fault;
    check_call(Tag(), args...);
    current_call = Tag::kName;
    const VkResult result = make_call(Tag(), args...);
    current_call = nullptr;
    if (result != VK_SUCCESS) return result;
    if constexpr (Tag::kHandle != nullptr) {
      self.created(Tag::kHandle);
      self.work.destroyed(as_handle(*std::get<sizeof...(Args) - 1>(std::make_tuple(args...))));  // its former owner
    }
    follow(self.work, Tag(), args...);
    if constexpr (std::is_same_v<Tag, vkAllocateMemoryTag>) {
      const auto all = std::make_tuple(args...);
      self.allocated(*std::get<3>(all), std::get<1>(all)->allocationSize);
    }
    if constexpr (std::is_same_v<Tag, vkCreateBufferTag>) {
      const std::lock_guard lock(self.buffers_mutex);
      const auto all = std::make_tuple(args...);
      self.buffer_sizes[*std::get<3>(all)] = std::get<1>(all)->size;
    }
    return result;
  }
};

/// Destroyers. The handle is the last argument but one.
template <class Tag, class... Args>
struct Hook<Tag, void (*)(Args...)> {
  static void call(Args... args) {
    const InDriver inside;
    const auto all = std::make_tuple(args...);
    VulkanInterposer& self = VulkanInterposer::get();
    if (std::get<sizeof...(Args) - 2>(all) != VK_NULL_HANDLE) {
      self.destroyed(Tag::kHandle);
      const WorkUnderWay::Handle handle = as_handle(std::get<sizeof...(Args) - 2>(all));
      if (self.work.uses(handle)) self.violation(std::string(Tag::kName) + " of what the device is using");
      self.work.destroyed(handle);
    }
    if constexpr (std::is_same_v<Tag, vkFreeMemoryTag>) self.freed(std::get<1>(all));
    if constexpr (std::is_same_v<Tag, vkDestroySemaphoreTag>) self.two_queues.forget(std::get<1>(all));
    call_real<Tag>(args...);
  }
};

PFN_vkVoidFunction stand_in(const char* name, PFN_vkVoidFunction real);

PFN_vkVoidFunction get_device_function(VkDevice device, const char* name) {
  const InDriver inside;
  return stand_in(name, call_real<vkGetDeviceProcAddrTag>(device, name));
}

template <class Tag>
PFN_vkVoidFunction keep(PFN_vkVoidFunction real, typename Tag::Function hook) {
  real_of<Tag>() = real;
  return reinterpret_cast<PFN_vkVoidFunction>(hook);
}

/// The replacement for those functions that have one, otherwise `real`.
PFN_vkVoidFunction stand_in(const char* name, PFN_vkVoidFunction real) {
  if (real == nullptr) return nullptr;
  const std::string_view wanted = name;
#define MEDIAL_VK_GENERIC(call_name, faults, handle) \
  if (wanted == #call_name) return keep<call_name##Tag>(real, &Hook<call_name##Tag, PFN_##call_name>::call);
  MEDIAL_VK_FALLIBLE(MEDIAL_VK_GENERIC)
  MEDIAL_VK_DESTROYERS(MEDIAL_VK_GENERIC)
  if (wanted == "vkEnumeratePhysicalDevices") return keep<vkEnumeratePhysicalDevicesTag>(real, enumerate);
  if (wanted == "vkGetPhysicalDeviceProperties") return keep<vkGetPhysicalDevicePropertiesTag>(real, get_properties);
  if (wanted == "vkGetPhysicalDeviceProperties2") return keep<vkGetPhysicalDeviceProperties2Tag>(real, get_properties2);
  if (wanted == "vkGetPhysicalDeviceQueueFamilyProperties")
    return keep<vkGetPhysicalDeviceQueueFamilyPropertiesTag>(real, get_families);
  if (wanted == "vkGetPhysicalDeviceMemoryProperties")
    return keep<vkGetPhysicalDeviceMemoryPropertiesTag>(real, get_memory);
  if (wanted == "vkGetPhysicalDeviceFormatProperties")
    return keep<vkGetPhysicalDeviceFormatPropertiesTag>(real, get_format);
  if (wanted == "vkGetBufferMemoryRequirements2")
    return keep<vkGetBufferMemoryRequirements2Tag>(real, get_requirements);
  if (wanted == "vkGetDeviceQueue") return keep<vkGetDeviceQueueTag>(real, get_queue);
  if (wanted == "vkUpdateDescriptorSets") return keep<vkUpdateDescriptorSetsTag>(real, update_sets);
  if (wanted == "vkCmdDispatch") return keep<vkCmdDispatchTag>(real, dispatch);
  if (wanted == "vkCmdDispatchIndirect") return keep<vkCmdDispatchIndirectTag>(real, dispatch_indirect);
  if (wanted == "vkCmdCopyBuffer") return keep<vkCmdCopyBufferTag>(real, copy_buffer);
  if (wanted == "vkCmdFillBuffer") return keep<vkCmdFillBufferTag>(real, fill_buffer);
  if (wanted == "vkCmdBindDescriptorSets") return keep<vkCmdBindDescriptorSetsTag>(real, bind_sets);
  if (wanted == "vkCmdBindPipeline") return keep<vkCmdBindPipelineTag>(real, bind_pipeline);
  if (wanted == "vkCmdWriteTimestamp") return keep<vkCmdWriteTimestampTag>(real, write_timestamp);
  if (wanted == "vkCmdBeginRenderPass") return keep<vkCmdBeginRenderPassTag>(real, begin_render_pass);
  if (wanted == "vkGetDeviceProcAddr") return keep<vkGetDeviceProcAddrTag>(real, get_device_function);
  return real;
}

PFN_vkGetInstanceProcAddr real_entry = nullptr;

PFN_vkVoidFunction get_instance_function(VkInstance instance, const char* name) {
  const InDriver inside;
  return stand_in(name, real_entry(instance, name));
}

}  // namespace
}  // namespace hooks

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return "out of host memory";
    case Fault::kOutOfDeviceMemory:
      return "out of device memory";
    case Fault::kDeviceFull:
      return "device full";
    case Fault::kDeviceLost:
      return "device lost";
    case Fault::kNone:
      break;
  }
  return "none";
}

bool in_driver() { return hooks::driver_depth > 0; }
const char* fallible_call() { return hooks::current_call; }

VulkanInterposer& VulkanInterposer::get() {
  static VulkanInterposer interposer;
  static const bool installed = [] {
    if (volkInitialize() != VK_SUCCESS) return false;  // no loader: the tests are skipped
    hooks::real_entry = vkGetInstanceProcAddr;
    volkInitializeCustom(hooks::get_instance_function);
    return true;
  }();
  static_cast<void>(installed);
  return interposer;
}

PFN_vkGetInstanceProcAddr VulkanInterposer::entry() { return hooks::get_instance_function; }

void VulkanInterposer::fail_call(std::uint64_t k, Fault fault) {
  const std::lock_guard lock(mutex_);
  calls_ = 0;
  fail_at_ = k;
  fault_ = fault;
  failed_.clear();
}

std::string VulkanInterposer::stop_failing() {
  const std::lock_guard lock(mutex_);
  fault_ = Fault::kNone;
  return failed_;
}

VkResult VulkanInterposer::next_result(const char* call, unsigned faults) {
  const std::lock_guard lock(mutex_);
  if ((faults & hooks::mask_of(fault_)) == 0) return VK_SUCCESS;
  const std::uint64_t number = ++calls_;
  const bool lasts = fault_ == Fault::kDeviceLost || fault_ == Fault::kDeviceFull;
  if (lasts ? number < fail_at_ : number != fail_at_) return VK_SUCCESS;
  if (failed_.empty()) failed_ = call;
  return hooks::result_of(fault_);
}

void VulkanInterposer::created(const char* type) {
  const std::lock_guard lock(mutex_);
  ++created_[type];
  if (std::strcmp(type, "VkDeviceMemory") == 0) {
    const auto alive = static_cast<std::uint64_t>(created_[type] - destroyed_[type]);
    usage_.allocations = std::max(usage_.allocations, alive);
  }
}

void VulkanInterposer::destroyed(const char* type) {
  const std::lock_guard lock(mutex_);
  ++destroyed_[type];
}

void VulkanInterposer::allocated(VkDeviceMemory memory, VkDeviceSize bytes) {
  const std::lock_guard lock(mutex_);
  memory_[memory] = bytes;
  VkDeviceSize alive = 0;
  for (const auto& [handle, size] : memory_) alive += size;
  usage_.memory_bytes = std::max<std::uint64_t>(usage_.memory_bytes, alive);
}

void VulkanInterposer::freed(VkDeviceMemory memory) {
  const std::lock_guard lock(mutex_);
  memory_.erase(memory);
}

std::map<std::string, std::int64_t> VulkanInterposer::handles() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::int64_t> alive = created_;
  for (const auto& [type, count] : destroyed_) alive[type] -= count;
  return alive;
}

std::string VulkanInterposer::leaks() const {
  std::string text;
  for (const auto& [type, count] : handles())
    if (count != 0) text += type + ": " + std::to_string(count) + " more created than destroyed\n";
  return text;
}

void VulkanInterposer::set_profile(DeviceProfile profile) {
  const std::lock_guard lock(mutex_);
  profile_ = std::move(profile);
  violations_.clear();
}

Usage VulkanInterposer::usage() const {
  const std::lock_guard lock(mutex_);
  return usage_;
}

void VulkanInterposer::clear_usage() {
  const std::lock_guard lock(mutex_);
  usage_ = {};
}

void VulkanInterposer::use(const std::function<void(Usage&)>& change_usage) {
  const std::lock_guard lock(mutex_);
  change_usage(usage_);
}

void VulkanInterposer::violation(std::string what) {
  const std::lock_guard lock(mutex_);
  violations_.push_back(std::move(what));
}

std::vector<std::string> VulkanInterposer::violations() const {
  const std::lock_guard lock(mutex_);
  return violations_;
}

}  // namespace medial_vk::test
