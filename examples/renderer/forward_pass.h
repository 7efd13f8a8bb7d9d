// The forward pass: first the opaque spheres, then the translucent mesh, into an image that is copied to the host for
// the file. A program with a window would use a swap chain instead of the image.
#pragma once

#include <medial_vk/extraction_job.h>

#include <cstdint>
#include <string>

#include "vulkan_host.h"

/// Push constants of both pipelines (shaders/camera.glsl).
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

class ForwardPass {
 public:
  ForwardPass(const VulkanHost& host, VkExtent2D size, const medial_vk::JobBuffers& spheres);
  ForwardPass(const ForwardPass&) = delete;
  ForwardPass& operator=(const ForwardPass&) = delete;
  ~ForwardPass();

  void record(VkCommandBuffer commands, const FrameConstants& constants, const DrawnMesh& mesh,
              const medial_vk::JobBuffers& spheres, VkBuffer pixels) const;
  VkDeviceSize pixel_bytes() const { return VkDeviceSize{4} * size_.width * size_.height; }

 private:
  void create_target();
  void create_layouts(const medial_vk::JobBuffers& spheres);
  VkPipeline create_pipeline(bool translucent_mesh) const;
  VkShaderModule create_shader(const std::uint32_t* code, std::size_t bytes) const;

  const VulkanHost& host_;
  VkExtent2D size_;
  HostImage colour_, depth_;
  VkRenderPass pass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline spheres_ = VK_NULL_HANDLE, mesh_ = VK_NULL_HANDLE;
};
