// How long the device works on the parts of a frame, by timestamps in its commands.
#pragma once

#include <cstdint>
#include <vector>

#include "vulkan_host.h"

class DeviceTimes {
 public:
  /// For frames in flight, each with a number of parts.
  DeviceTimes(const VulkanHost& host, std::uint32_t frames, std::uint32_t parts);
  DeviceTimes(const DeviceTimes&) = delete;
  DeviceTimes& operator=(const DeviceTimes&) = delete;
  ~DeviceTimes();

  /// Recorded before the first part of a frame, outside of a render pass, and then after each part.
  void mark(VkCommandBuffer commands, std::uint32_t frame);
  /// Precondition: the frame has finished, and every part has been marked.
  void add(std::uint32_t frame);

  /// Of all frames that have been added, in milliseconds. Negative: the queue counts no time.
  double mean(std::uint32_t part) const;

 private:
  const VulkanHost& host_;
  std::uint32_t marks_;  // of a frame
  std::uint64_t mask_ = 0;
  double milliseconds_ = 0;  // of a tick
  VkQueryPool pool_ = VK_NULL_HANDLE;
  std::vector<std::uint32_t> next_;  // by frame in flight
  std::vector<double> sums_;         // by part
  std::uint32_t added_ = 0;
};
