#include "device/device_selection.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "device/context_impl.h"
#include "device/required_limits.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, 5> kTypesByRank = {"discrete", "integrated", "virtual", "cpu", "other"};

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string driver_text(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  // The driver's own name is a struct of Vulkan 1.2; older devices only give a number in a format of their own.
  if (properties.apiVersion < VK_API_VERSION_1_2) return "version " + std::to_string(properties.driverVersion);
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 query{};
  query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  query.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &query);
  std::string text = driver.driverName;
  if (driver.driverInfo[0] != '\0') text += std::string(" ") + driver.driverInfo;
  return text;
}

std::vector<DeviceHeap> heaps_of(VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  std::vector<DeviceHeap> heaps;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = memory.memoryHeaps[i];
    heaps.push_back({heap.size, (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0});
  }
  return heaps;
}

std::uint64_t largest_local_heap(const std::vector<DeviceHeap>& heaps) {
  std::uint64_t largest = 0;
  for (const DeviceHeap& heap : heaps) largest = std::max(largest, heap.is_local ? heap.bytes : 0);
  return largest;
}

std::vector<std::string> operation_names(VkSubgroupFeatureFlags operations) {
  constexpr std::pair<VkSubgroupFeatureFlags, const char*> kNames[] = {
      {VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},
      {VK_SUBGROUP_FEATURE_VOTE_BIT, "vote"},
      {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"},
      {VK_SUBGROUP_FEATURE_BALLOT_BIT, "ballot"},
      {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle"},
      {VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT, "shuffle relative"},
      {VK_SUBGROUP_FEATURE_CLUSTERED_BIT, "clustered"},
      {VK_SUBGROUP_FEATURE_QUAD_BIT, "quad"}};
  std::vector<std::string> names;
  for (const auto& [bit, name] : kNames)
    if ((operations & bit) != 0) names.emplace_back(name);
  return names;
}

DeviceSubgroups subgroups_of(VkPhysicalDevice device, std::uint32_t api_version) {
  if (api_version < VK_API_VERSION_1_1) return {};  // which added them
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  VkPhysicalDeviceProperties2 query{};
  query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  query.pNext = &subgroup;
  vkGetPhysicalDeviceProperties2(device, &query);
  return {subgroup.subgroupSize, operation_names(subgroup.supportedOperations),
          (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0};
}

/// A family with compute, without graphics if there is such a family: on a desktop the other one draws the windows,
/// which then stay responsive during the computation.
std::optional<std::uint32_t> compute_family(std::span<const VkQueueFamilyProperties> families) {
  std::optional<std::uint32_t> found;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0 || families[i].queueCount == 0) continue;
    if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) return i;
    if (!found) found = i;
  }
  return found;
}

std::vector<VkQueueFamilyProperties> families_of(VkPhysicalDevice handle) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, families.data());
  return families;
}

/// The only test of a device's suitability; everything that opens, adopts or lists devices goes through it.
std::vector<std::string> reasons_against(const DeviceDescription& device, bool has_compute) {
  std::vector<std::string> reasons;
  if (device.api_version < VK_API_VERSION_1_2)
    reasons.push_back("it has Vulkan " + version_text(device.api_version) + ", 1.2 is needed");
  if (!has_compute) reasons.emplace_back("it has no compute queue");
  for (std::string& reason : limits_too_low(device.limits)) reasons.push_back(std::move(reason));
  return reasons;
}

PhysicalDevice describe(VkPhysicalDevice handle, std::uint32_t index) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(handle, &properties);
  const std::vector<VkQueueFamilyProperties> families = families_of(handle);

  PhysicalDevice device;
  device.handle = handle;
  DeviceDescription& description = device.description;
  description.index = index;
  description.name = properties.deviceName;
  description.type = type_name(properties.deviceType);
  description.driver = driver_text(handle, properties);
  description.api_version = properties.apiVersion;
  description.limits = compare_limits(properties.limits);
  description.heaps = heaps_of(handle);
  description.memory_bytes = largest_local_heap(description.heaps);
  description.subgroups = subgroups_of(handle, properties.apiVersion);

  const std::optional<std::uint32_t> family = compute_family(families);
  description.why_not = reasons_against(description, family.has_value());
  description.usable = description.why_not.empty();
  if (description.usable) {
    device.queue_family = *family;
    device.timestamp_valid_bits = families[*family].timestampValidBits;
    device.transfer_family = choose_transfer_family(families);
  }
  return device;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::size_t rank(const DeviceDescription& device) {
  const auto found = std::find(kTypesByRank.begin(), kTypesByRank.end(), device.type);
  return static_cast<std::size_t>(found - kTypesByRank.begin());
}

std::string list_text(std::span<const DeviceDescription> devices) {
  std::string text;
  for (const DeviceDescription& device : devices) {
    text += text.empty() ? "" : "; ";
    text += std::to_string(device.index) + ": " + device.name + " (" + device.type + ")";
    if (!device.usable) text += " - not usable, " + reasons_text(device);
  }
  return text;
}

/// The index, if `choice` is a number and a device has it. A number that no device has may still be part of a name.
std::optional<std::uint32_t> as_index(const std::string& choice, std::size_t count) {
  std::uint32_t index = 0;
  const char* end = choice.data() + choice.size();
  const auto [stopped, error] = std::from_chars(choice.data(), end, index);
  if (error != std::errc() || stopped != end || index >= count) return std::nullopt;
  return index;
}

}  // namespace

std::optional<std::uint32_t> choose_transfer_family(std::span<const VkQueueFamilyProperties> families) {
  // Not those of video, whose engines serve other work.
  constexpr VkQueueFlags kAllowed = VK_QUEUE_TRANSFER_BIT | VK_QUEUE_SPARSE_BINDING_BIT | VK_QUEUE_PROTECTED_BIT;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    const VkQueueFlags flags = families[i].queueFlags;
    if ((flags & VK_QUEUE_TRANSFER_BIT) != 0 && (flags & ~kAllowed) == 0 && families[i].queueCount > 0) return i;
  }
  return std::nullopt;
}

std::string reasons_text(const DeviceDescription& device) {
  std::string text;
  for (const std::string& reason : device.why_not) text += (text.empty() ? "" : "; ") + reason;
  return text;
}

Result<std::vector<PhysicalDevice>> enumerate_devices(VkInstance instance) {
  std::vector<VkPhysicalDevice> handles;
  VkResult result = VK_INCOMPLETE;
  // A device may appear between the two calls; after some tries an incomplete list is accepted.
  for (int attempt = 0; attempt < 8 && result == VK_INCOMPLETE; ++attempt) {
    std::uint32_t count = 0;
    result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
    if (result != VK_SUCCESS) break;
    handles.resize(count);
    result = vkEnumeratePhysicalDevices(instance, &count, handles.data());
    handles.resize(count);
  }
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) {
    Error error = vulkan_error("vkEnumeratePhysicalDevices", result);
    if (error.code != ErrorCode::kOutOfMemory) error.code = ErrorCode::kNoDevice;
    // So the loader answers where drivers are installed for devices that are not there.
    if (result == VK_ERROR_INITIALIZATION_FAILED) error.message = "no Vulkan driver finds a device; " + error.message;
    return error;
  }
  std::vector<PhysicalDevice> devices;
  for (std::uint32_t i = 0; i < handles.size(); ++i) devices.push_back(describe(handles[i], i));
  return devices;
}

PhysicalDevice describe_device(VkPhysicalDevice handle, std::uint32_t queue_family) {
  PhysicalDevice device = describe(handle, 0);
  const std::vector<VkQueueFamilyProperties> families = families_of(handle);
  if (!device.description.usable) return device;
  if (queue_family >= families.size() || (families[queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
    device.description.usable = false;
    device.description.why_not = {"its queue family " + std::to_string(queue_family) + " does not compute"};
    return device;
  }
  device.queue_family = queue_family;
  device.timestamp_valid_bits = families[queue_family].timestampValidBits;
  return device;
}

Result<std::uint32_t> choose_device(std::span<const DeviceDescription> devices, const std::string& choice,
                                    const std::string& origin) {
  if (devices.empty()) {
    return Error{ErrorCode::kNoDevice,
                 "Vulkan lists no device; install a driver such as mesa-vulkan-drivers (it computes on the CPU)"};
  }
  if (const auto index = as_index(choice, devices.size())) {
    const DeviceDescription& device = devices[*index];
    if (device.usable) return *index;
    return Error{ErrorCode::kNoDevice,
                 origin + " " + choice + ": \"" + device.name + "\" cannot be used: " + reasons_text(device)};
  }

  const std::string wanted = lower_case(choice);  // empty: part of every name
  const DeviceDescription* best = nullptr;
  for (const DeviceDescription& device : devices) {
    if (!device.usable || lower_case(device.name).find(wanted) == std::string::npos) continue;
    if (best == nullptr || rank(device) < rank(*best)) best = &device;
  }
  if (best != nullptr) return best->index;
  const std::string subject =
      choice.empty() ? "no usable Vulkan device" : origin + " \"" + choice + "\" matches no usable Vulkan device";
  return Error{ErrorCode::kNoDevice, subject + "; there are: " + list_text(devices)};
}

}  // namespace medial_vk
