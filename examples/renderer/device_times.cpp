#include "device_times.h"

DeviceTimes::DeviceTimes(const VulkanHost& host, std::uint32_t frames, std::uint32_t parts)
    : host_(host), marks_(parts + 1), next_(frames), sums_(parts) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(host_.physical_device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(host_.physical_device, &count, families.data());
  const std::uint32_t bits = families[host_.queue_family].timestampValidBits;
  if (bits == 0) return;
  mask_ = ~std::uint64_t{0} >> (64 - bits);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(host_.physical_device, &properties);
  milliseconds_ = 1e-6 * static_cast<double>(properties.limits.timestampPeriod);
  auto info = vulkan_struct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = frames * marks_;
  check(vkCreateQueryPool(host_.device, &info, nullptr, &pool_), "vkCreateQueryPool");
}

DeviceTimes::~DeviceTimes() { vkDestroyQueryPool(host_.device, pool_, nullptr); }

void DeviceTimes::mark(VkCommandBuffer commands, std::uint32_t frame) {
  if (pool_ == VK_NULL_HANDLE) return;
  if (next_[frame] == 0) vkCmdResetQueryPool(commands, pool_, frame * marks_, marks_);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, frame * marks_ + next_[frame]);
  next_[frame] = (next_[frame] + 1) % marks_;
}

void DeviceTimes::add(std::uint32_t frame) {
  if (pool_ == VK_NULL_HANDLE) return;
  std::vector<std::uint64_t> ticks(marks_);
  check(vkGetQueryPoolResults(host_.device, pool_, frame * marks_, marks_, marks_ * sizeof(std::uint64_t), ticks.data(),
                              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT),
        "vkGetQueryPoolResults");
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums_[i] += milliseconds_ * static_cast<double>((ticks[i + 1] - ticks[i]) & mask_);
  }
  ++added_;
}

double DeviceTimes::mean(std::uint32_t part) const { return added_ == 0 ? -1 : sums_[part] / added_; }
