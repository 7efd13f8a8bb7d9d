#include "output/picture/vulkan/drawing_pipelines.h"

#include <span>

#include "ball.frag.h"
#include "ball.vert.h"
#include "compose.frag.h"
#include "compose.vert.h"
#include "disc.frag.h"
#include "disc.vert.h"
#include "mesh.frag.h"
#include "mesh.vert.h"

namespace medial_vk::picture {
namespace {

constexpr VkPipelineStageFlags kAttachmentStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                   VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                   VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags kAttachmentWrites =
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

VkAttachmentDescription attachment(VkFormat format, VkImageLayout afterwards) {
  VkAttachmentDescription made{};
  made.format = format;
  made.samples = VK_SAMPLE_COUNT_1_BIT;
  made.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  made.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  made.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  made.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  made.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  made.finalLayout = afterwards;
  return made;
}

VkRenderPass create_pass(DrawingDevice& device, std::span<const VkAttachmentDescription> attachments,
                         const std::array<VkSubpassDependency, 2>& dependencies) {
  const VkAttachmentReference colour = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colour;
  subpass.pDepthStencilAttachment = attachments.size() > 1 ? &depth : nullptr;
  auto info = vulkan_struct<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  VkRenderPass pass = VK_NULL_HANDLE;
  DrawingDevice::check(device.vk.CreateRenderPass(device.device, &info, nullptr, &pass), "vkCreateRenderPass");
  device.at_end([&device, pass] { device.vk.DestroyRenderPass(device.device, pass, nullptr); });
  return pass;
}

/// Runs after the previous tile has read the layers, and before this tile reads them.
VkRenderPass create_layer_pass(DrawingDevice& device) {
  const std::array attachments = {attachment(kLayerFormat, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
                                  attachment(kDepthFormat, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL)};
  return create_pass(
      device, attachments,
      {{{VK_SUBPASS_EXTERNAL, 0, kAttachmentStages | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, kAttachmentStages,
         kAttachmentWrites, kAttachmentWrites | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0},
        {0, VK_SUBPASS_EXTERNAL, kAttachmentStages, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | kAttachmentStages,
         kAttachmentWrites, VK_ACCESS_SHADER_READ_BIT | kAttachmentWrites, 0}}});
}

VkRenderPass create_compose_pass(DrawingDevice& device) {
  const std::array attachments = {attachment(kPixelFormat, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
  return create_pass(
      device, attachments,
      {{{VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
         VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
         VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0},
        {0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
         VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0}}});
}

VkDescriptorSetLayout create_set_layout(DrawingDevice& device) {
  std::array<VkDescriptorSetLayoutBinding, 6> bindings{};
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i].binding = i;
    bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    bindings[i].descriptorCount = 1;
    bindings[i].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
  }
  bindings[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
  bindings[0].stageFlags = VK_SHADER_STAGE_VERTEX_BIT;
  bindings[1].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  auto info = vulkan_struct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  DrawingDevice::check(device.vk.CreateDescriptorSetLayout(device.device, &info, nullptr, &layout),
                       "vkCreateDescriptorSetLayout");
  device.at_end([&device, layout] { device.vk.DestroyDescriptorSetLayout(device.device, layout, nullptr); });
  return layout;
}

VkPipelineLayout create_layout(DrawingDevice& device, VkDescriptorSetLayout set_layout) {
  const VkPushConstantRange constants = {kDrawingStages, 0, sizeof(PanelConstants)};
  auto info = vulkan_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  DrawingDevice::check(device.vk.CreatePipelineLayout(device.device, &info, nullptr, &layout),
                       "vkCreatePipelineLayout");
  device.at_end([&device, layout] { device.vk.DestroyPipelineLayout(device.device, layout, nullptr); });
  return layout;
}

/// A shader module that is destroyed once the pipeline exists.
class Shader {
 public:
  Shader(DrawingDevice& device, std::span<const std::uint32_t> code) : device_(device) {
    auto info = vulkan_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    DrawingDevice::check(device.vk.CreateShaderModule(device.device, &info, nullptr, &handle), "vkCreateShaderModule");
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { device_.vk.DestroyShaderModule(device_.device, handle, nullptr); }

  VkShaderModule handle = VK_NULL_HANDLE;

 private:
  DrawingDevice& device_;
};

struct PipelineRequest {
  std::span<const std::uint32_t> vertex, fragment;
  VkRenderPass pass = VK_NULL_HANDLE;
  VkExtent2D size{};
  bool has_attributes = false;  // positions and normals
  bool has_depth = true;
  VkCompareOp keep = VK_COMPARE_OP_GREATER;  // depth 1 is near
};

VkPipeline create_pipeline(DrawingDevice& device, VkPipelineLayout layout, const PipelineRequest& request) {
  const Shader vertex(device, request.vertex), fragment(device, request.fragment);
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertex.handle;
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = fragment.handle;

  const std::array<VkVertexInputBindingDescription, 2> bindings = {
      {{0, 3 * sizeof(float), VK_VERTEX_INPUT_RATE_VERTEX}, {1, 3 * sizeof(float), VK_VERTEX_INPUT_RATE_VERTEX}}};
  const std::array<VkVertexInputAttributeDescription, 2> attributes = {
      {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 1, VK_FORMAT_R32G32B32_SFLOAT, 0}}};
  auto input =
      vulkan_struct<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  if (request.has_attributes) {
    input.vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size());
    input.pVertexBindingDescriptions = bindings.data();
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();
  }
  auto assembly = vulkan_struct<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport = {0, 0, static_cast<float>(request.size.width), static_cast<float>(request.size.height),
                               0, 1};
  const VkRect2D scissor = {{0, 0}, request.size};
  auto area = vulkan_struct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  area.viewportCount = 1;
  area.pViewports = &viewport;
  area.scissorCount = 1;
  area.pScissors = &scissor;
  auto raster =
      vulkan_struct<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1;
  auto samples =
      vulkan_struct<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto depth =
      vulkan_struct<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = request.keep;
  VkPipelineColorBlendAttachmentState blend{};
  blend.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  auto blending =
      vulkan_struct<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blending.attachmentCount = 1;
  blending.pAttachments = &blend;

  auto info = vulkan_struct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &area;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = request.has_depth ? &depth : nullptr;
  info.pColorBlendState = &blending;
  info.layout = layout;
  info.renderPass = request.pass;
  VkPipeline pipeline = VK_NULL_HANDLE;
  DrawingDevice::check(device.vk.CreateGraphicsPipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                       "vkCreateGraphicsPipelines");
  device.at_end([&device, pipeline] { device.vk.DestroyPipeline(device.device, pipeline, nullptr); });
  return pipeline;
}

}  // namespace

DrawingPipelines::DrawingPipelines(DrawingDevice& device, VkExtent2D layer, VkExtent2D tile)
    : layer_pass(create_layer_pass(device)),
      compose_pass(create_compose_pass(device)),
      set_layout(create_set_layout(device)),
      layout(create_layout(device, set_layout)) {
  PipelineRequest wall = {kMeshVert, kMeshFrag, layer_pass, layer, true, true, VK_COMPARE_OP_GREATER};
  front = create_pipeline(device, layout, wall);
  wall.keep = VK_COMPARE_OP_LESS;
  back = create_pipeline(device, layout, wall);
  discs = create_pipeline(device, layout, {kDiscVert, kDiscFrag, layer_pass, layer});
  balls = create_pipeline(device, layout, {kBallVert, kBallFrag, layer_pass, layer});
  compose = create_pipeline(device, layout, {kComposeVert, kComposeFrag, compose_pass, tile, false, false});
}

}  // namespace medial_vk::picture
