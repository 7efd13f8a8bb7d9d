// Targets and state of drawing: render passes, layouts, pipelines.
#pragma once

#include <array>

#include "output/picture/vulkan/drawing_device.h"

namespace medial_vk::picture {

/// Push constants of all stages: shaders/panel.glsl.
struct PanelConstants {
  std::array<float, 4> right{}, up{}, towards{}, layer{}, depth{}, place{};
  std::array<std::uint32_t, 4> what{};
};
static_assert(sizeof(PanelConstants) == 112);

constexpr VkFormat kLayerFormat = VK_FORMAT_R16G16B16A16_SFLOAT, kDepthFormat = VK_FORMAT_D32_SFLOAT,
                   kPixelFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkShaderStageFlags kDrawingStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

struct DrawingPipelines {
  /// `layer` and `tile` are the sizes of the targets, in samples and pixels. Throws DrawingError.
  DrawingPipelines(DrawingDevice& device, VkExtent2D layer, VkExtent2D tile);

  VkRenderPass layer_pass = VK_NULL_HANDLE, compose_pass = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline front = VK_NULL_HANDLE, back = VK_NULL_HANDLE, discs = VK_NULL_HANDLE, balls = VK_NULL_HANDLE,
             compose = VK_NULL_HANDLE;
};

}  // namespace medial_vk::picture
