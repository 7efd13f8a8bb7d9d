// The physical devices, their suitability, and the choice of one.
#pragma once

#include <volk.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A physical device with the family of queues that the library would use.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;                // meaningful if description.usable
  std::uint32_t timestamp_valid_bits = 0;        // of that family
  std::optional<std::uint32_t> transfer_family;  // one that only copies, if there is one
  DeviceDescription description;
};

/// The reasons why it is not usable, separated by semicolons.
std::string reasons_text(const DeviceDescription& device);

/// A family that only copies: its queues are engines of their own, which run in parallel with the others.
std::optional<std::uint32_t> choose_transfer_family(std::span<const VkQueueFamilyProperties> families);

/// All devices in Vulkan's order. Precondition: volk_mutex() is held, volk is loaded for `instance`.
/// Errors: kNoDevice, kOutOfMemory. No device at all is an empty list, not an error.
Result<std::vector<PhysicalDevice>> enumerate_devices(VkInstance instance);

/// A device with a given family of queues; usable if that family is suitable. Preconditions as above.
PhysicalDevice describe_device(VkPhysicalDevice handle, std::uint32_t queue_family);

/// The device given by `choice`: an index, part of a name (case does not matter; of several the best), or, empty,
/// the best of all: discrete, integrated, virtual, cpu, other; the first listed among equals.
/// `origin` names the source of the choice in errors ("`device`", "MEDIAL_VK_DEVICE").
/// Returns the index. Errors: kNoDevice, listing what exists.
Result<std::uint32_t> choose_device(std::span<const DeviceDescription> devices, const std::string& choice,
                                    const std::string& origin);

}  // namespace medial_vk
