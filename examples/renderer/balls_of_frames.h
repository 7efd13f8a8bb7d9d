// Two ways to have balls inside a mesh that deforms, frame by frame, on the device: they follow it, or are searched
// anew.
#pragma once

#include <medial_vk/extraction_job.h>
#include <medial_vk/follower_job.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vulkan_host.h"

void check(const medial_vk::Status& status);

template <class T>
T take(medial_vk::Result<T> result) {
  if (!result) fail(result.error().message.c_str());
  return std::move(result).value();
}

/// Time of the host for one way, over all frames.
struct HostTimes {
  using Seconds = std::chrono::duration<double>;
  Seconds moving{}, recording{};
};

/// The medial spheres of each frame, found without those of the frame before.
class SearchedBalls {
 public:
  SearchedBalls(medial_vk::Context& context, const medial_vk::IndexedMesh& mesh, std::uint32_t frames_in_flight);

  void record(VkCommandBuffer commands, std::span<const medial_vk::Point> vertices);
  /// For the oldest frame, which has finished: six words of the job for the host.
  void count();

  const medial_vk::ExtractionJob& job() const { return job_; }
  const HostTimes& times() const { return times_; }
  std::uint32_t spheres() const { return spheres_; }

 private:
  medial_vk::IndexedMesh mesh_;
  medial_vk::ExtractionJob job_;
  std::uint32_t spheres_ = 0;
  HostTimes times_;
};

/// The medial spheres at rest, which follow the mesh.
class FollowedBalls {
 public:
  FollowedBalls(const VulkanHost& host, medial_vk::Context& context, const medial_vk::IndexedMesh& rest,
                std::uint32_t frames_in_flight);
  FollowedBalls(const FollowedBalls&) = delete;
  FollowedBalls& operator=(const FollowedBalls&) = delete;
  ~FollowedBalls();

  void record(VkCommandBuffer commands, std::span<const medial_vk::Point> vertices);

  const medial_vk::FollowerJob& job() const { return job_; }
  VkBuffer angles() const { return angles_.handle; }  ///< The object angle of each at rest, a float.
  const HostTimes& times() const { return times_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(at_rest_.size()); }

 private:
  const VulkanHost& host_;
  std::vector<medial_vk::MedialSphere> at_rest_;
  medial_vk::FollowerJob job_;
  HostBuffer angles_;
  HostTimes times_;
};
