#include "device/required_limits.h"

#include <array>

namespace medial_vk {
namespace {

using Limits = VkPhysicalDeviceLimits;

// A test runs every kind of job and compares with what its programs bind (tests/faults/tiny_limits_test.cpp). Kernels
// bind 14 storage buffers at most, but no device stops between 8 and 16.
constexpr auto kRequired = std::to_array<RequiredLimit>({
    {"maxPerStageDescriptorStorageBuffers", 16,
     [](Limits& l) -> std::uint32_t& { return l.maxPerStageDescriptorStorageBuffers; }},
    {"maxDescriptorSetStorageBuffers", 16,
     [](Limits& l) -> std::uint32_t& { return l.maxDescriptorSetStorageBuffers; }},
    {"maxPerStageDescriptorSampledImages", 3,
     [](Limits& l) -> std::uint32_t& { return l.maxPerStageDescriptorSampledImages; }},
    {"maxPerStageResources", 19, [](Limits& l) -> std::uint32_t& { return l.maxPerStageResources; }},
    {"maxPushConstantsSize", 128, [](Limits& l) -> std::uint32_t& { return l.maxPushConstantsSize; }},
    // 256 lanes gather the contacts of a top cell, or resolve a query that a walk gave up.
    {"maxComputeWorkGroupInvocations", 256,
     [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupInvocations; }},
    {"maxComputeWorkGroupSize[0]", 256, [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupSize[0]; }},
    {"maxComputeSharedMemorySize", 16384, [](Limits& l) -> std::uint32_t& { return l.maxComputeSharedMemorySize; }},
    // Dispatches sized on the device have rows of 32,768 groups (shaders/shared/lanes/prepare.glsl).
    {"maxComputeWorkGroupCount[0]", 32768, [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupCount[0]; }},
    {"maxComputeWorkGroupCount[1]", 65535, [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupCount[1]; }},
});

}  // namespace

std::span<const RequiredLimit> required_limits() { return kRequired; }

std::vector<DeviceLimit> compare_limits(VkPhysicalDeviceLimits limits) {
  std::vector<DeviceLimit> compared;
  compared.reserve(kRequired.size());
  for (const RequiredLimit& limit : kRequired) compared.push_back({limit.name, limit.needed, limit.of(limits)});
  return compared;
}

std::vector<std::string> limits_too_low(const std::vector<DeviceLimit>& limits) {
  std::vector<std::string> reasons;
  for (const DeviceLimit& limit : limits) {
    if (limit.there >= limit.needed) continue;
    reasons.push_back("its " + limit.name + " is " + std::to_string(limit.there) + ", " + std::to_string(limit.needed) +
                      " are needed");
  }
  return reasons;
}

}  // namespace medial_vk
