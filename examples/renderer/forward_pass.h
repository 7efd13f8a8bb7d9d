// The forward pass: first the opaque balls, then the translucent mesh, into an image that is copied to the host for the
// file. A program with a window would use a swap chain instead of the image. Panels side by side show the same mesh,
// each with balls of its own.
#pragma once

#include <medial_vk/extraction_job.h>
#include <medial_vk/follower_job.h>

#include <array>
#include <cstdint>
#include <vector>

#include "vulkan_host.h"

/// Push constants of all pipelines (shaders/camera.glsl).
struct FrameConstants {
  float to_clip[16];  // columns
  float eye[4];
  float placement[4];
};

/// The inputs of a frame.
struct DrawnMesh {
  VkBuffer vertices, indices;
  std::uint32_t index_count;
};

/// The balls of a panel, in buffers that a job writes.
struct DrawnBalls {
  bool are_followed;
  std::array<VkBuffer, 3> buffers;  // in the bindings of its vertex shader
  VkBuffer arguments;               // of vkCmdDrawIndirect; none: there are `count`
  std::uint32_t count;
};

DrawnBalls searched_balls(const medial_vk::JobBuffers& job);
/// `angles` has the object angle of each at rest, a float.
DrawnBalls followed_balls(const medial_vk::FollowerBuffers& job, VkBuffer angles, std::uint32_t count);

class ForwardPass {
 public:
  /// A panel of this size for each set of balls, from left to right.
  ForwardPass(const VulkanHost& host, VkExtent2D panel, std::vector<DrawnBalls> balls);
  ForwardPass(const ForwardPass&) = delete;
  ForwardPass& operator=(const ForwardPass&) = delete;
  ~ForwardPass();

  void record(VkCommandBuffer commands, const FrameConstants& constants, const DrawnMesh& mesh, VkBuffer pixels) const;
  VkExtent2D size() const { return size_; }  ///< Of all panels together.
  VkDeviceSize pixel_bytes() const { return VkDeviceSize{4} * size_.width * size_.height; }

 private:
  enum class Kind { kMesh, kSearched, kFollowed };

  void create_target();
  void create_layouts();
  void create_sets();
  VkPipeline create_pipeline(Kind kind) const;
  std::array<VkPipelineShaderStageCreateInfo, 2> create_stages(Kind kind) const;
  VkShaderModule create_shader(const std::uint32_t* code, std::size_t bytes) const;
  void draw_panel(VkCommandBuffer commands, std::size_t panel, const DrawnMesh& mesh) const;

  const VulkanHost& host_;
  VkExtent2D panel_, size_;
  std::vector<DrawnBalls> balls_;
  HostImage colour_, depth_;
  VkRenderPass pass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  std::vector<VkDescriptorSet> sets_;  // by panel
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline mesh_ = VK_NULL_HANDLE;
  std::vector<VkPipeline> pipelines_;  // by panel, of its balls
};
