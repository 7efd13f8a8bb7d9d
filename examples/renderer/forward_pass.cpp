#include "forward_pass.h"

#include <cstddef>
#include <utility>

#include "followed.vert.h"
#include "mesh.frag.h"
#include "mesh.vert.h"
#include "sphere.frag.h"
#include "sphere.vert.h"

namespace {

constexpr VkFormat kColour = VK_FORMAT_R8G8B8A8_SRGB, kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

}  // namespace

DrawnBalls searched_balls(const medial_vk::JobBuffers& job) {
  return {false, {job.spheres, VK_NULL_HANDLE, VK_NULL_HANDLE}, job.counts, 0};
}

DrawnBalls followed_balls(const medial_vk::FollowerBuffers& job, VkBuffer angles, std::uint32_t count) {
  return {true, {job.balls, job.states, angles}, VK_NULL_HANDLE, count};
}

ForwardPass::ForwardPass(const VulkanHost& host, VkExtent2D panel, std::vector<DrawnBalls> balls)
    : host_(host),
      panel_(panel),
      size_{panel.width * static_cast<std::uint32_t>(balls.size()), panel.height},
      balls_(std::move(balls)) {
  create_target();
  create_layouts();
  create_sets();
  mesh_ = create_pipeline(Kind::kMesh);
  for (const DrawnBalls& drawn : balls_) {
    pipelines_.push_back(create_pipeline(drawn.are_followed ? Kind::kFollowed : Kind::kSearched));
  }
}

ForwardPass::~ForwardPass() {
  for (const VkPipeline pipeline : pipelines_) vkDestroyPipeline(host_.device, pipeline, nullptr);
  vkDestroyPipeline(host_.device, mesh_, nullptr);
  vkDestroyPipelineLayout(host_.device, layout_, nullptr);
  vkDestroyDescriptorPool(host_.device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(host_.device, set_layout_, nullptr);
  vkDestroyFramebuffer(host_.device, framebuffer_, nullptr);
  vkDestroyRenderPass(host_.device, pass_, nullptr);
  host_.destroy(colour_);
  host_.destroy(depth_);
}

void ForwardPass::create_target() {
  colour_ = host_.create_image(size_, kColour, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT);
  depth_ = host_.create_image(size_, kDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);

  std::array<VkAttachmentDescription, 2> attachments{};
  for (VkAttachmentDescription& attachment : attachments) {
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  }
  attachments[0].format = kColour;
  attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachments[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  attachments[1].format = kDepth;
  attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference colour = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colour;
  subpass.pDepthStencilAttachment = &depth;
  constexpr VkPipelineStageFlags kAttachmentStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                     VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                     VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags kAttachmentWrites =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  // All frames share the images: the pass runs after the copy and the tests of the previous frame, and before its own
  // copy.
  const std::array<VkSubpassDependency, 2> dependencies = {
      {{VK_SUBPASS_EXTERNAL, 0, kAttachmentStages | VK_PIPELINE_STAGE_TRANSFER_BIT, kAttachmentStages,
        kAttachmentWrites, kAttachmentWrites | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0},
       {0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0}}};
  auto info = vulkan_struct<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  check(vkCreateRenderPass(host_.device, &info, nullptr, &pass_), "vkCreateRenderPass");

  const std::array<VkImageView, 2> views = {colour_.view, depth_.view};
  auto framebuffer = vulkan_struct<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  framebuffer.renderPass = pass_;
  framebuffer.attachmentCount = static_cast<std::uint32_t>(views.size());
  framebuffer.pAttachments = views.data();
  framebuffer.width = size_.width;
  framebuffer.height = size_.height;
  framebuffer.layers = 1;
  check(vkCreateFramebuffer(host_.device, &framebuffer, nullptr, &framebuffer_), "vkCreateFramebuffer");
}

void ForwardPass::create_layouts() {
  std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr};
  }
  auto layout = vulkan_struct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  layout.bindingCount = static_cast<std::uint32_t>(bindings.size());
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(host_.device, &layout, nullptr, &set_layout_), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange constants = {kStages, 0, sizeof(FrameConstants)};
  auto info = vulkan_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout_;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  check(vkCreatePipelineLayout(host_.device, &info, nullptr, &layout_), "vkCreatePipelineLayout");
}

// The vertex shaders read the buffers that the jobs write.
void ForwardPass::create_sets() {
  const auto panels = static_cast<std::uint32_t>(balls_.size());
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3 * panels};
  auto pool = vulkan_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = panels;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  check(vkCreateDescriptorPool(host_.device, &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  const std::vector<VkDescriptorSetLayout> layouts(panels, set_layout_);
  sets_.resize(panels);
  auto allocation = vulkan_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocation.descriptorPool = pool_;
  allocation.descriptorSetCount = panels;
  allocation.pSetLayouts = layouts.data();
  check(vkAllocateDescriptorSets(host_.device, &allocation, sets_.data()), "vkAllocateDescriptorSets");
  for (std::size_t panel = 0; panel < balls_.size(); ++panel) {
    for (std::uint32_t binding = 0; binding < balls_[panel].buffers.size(); ++binding) {
      const VkDescriptorBufferInfo range = {balls_[panel].buffers[binding], 0, VK_WHOLE_SIZE};
      if (range.buffer == VK_NULL_HANDLE) continue;
      auto write = vulkan_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
      write.dstSet = sets_[panel];
      write.dstBinding = binding;
      write.descriptorCount = 1;
      write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      write.pBufferInfo = &range;
      vkUpdateDescriptorSets(host_.device, 1, &write, 0, nullptr);
    }
  }
}

VkShaderModule ForwardPass::create_shader(const std::uint32_t* code, std::size_t bytes) const {
  auto info = vulkan_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  info.codeSize = bytes;
  info.pCode = code;
  VkShaderModule shader = VK_NULL_HANDLE;
  check(vkCreateShaderModule(host_.device, &info, nullptr, &shader), "vkCreateShaderModule");
  return shader;
}

std::array<VkPipelineShaderStageCreateInfo, 2> ForwardPass::create_stages(Kind kind) const {
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  if (kind == Kind::kMesh) {
    stages[0].module = create_shader(kMeshVert, sizeof(kMeshVert));
    stages[1].module = create_shader(kMeshFrag, sizeof(kMeshFrag));
  } else {
    stages[0].module = kind == Kind::kSearched ? create_shader(kSphereVert, sizeof(kSphereVert))
                                               : create_shader(kFollowedVert, sizeof(kFollowedVert));
    stages[1].module = create_shader(kSphereFrag, sizeof(kSphereFrag));
  }
  return stages;
}

// long: all state of a pipeline, one member after the other.
VkPipeline ForwardPass::create_pipeline(Kind kind) const {
  const bool translucent_mesh = kind == Kind::kMesh;
  const std::array<VkPipelineShaderStageCreateInfo, 2> stages = create_stages(kind);
  const VkVertexInputBindingDescription binding = {0, 6 * sizeof(float), VK_VERTEX_INPUT_RATE_VERTEX};
  const std::array<VkVertexInputAttributeDescription, 2> attributes = {
      {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32_SFLOAT, 3 * sizeof(float)}}};
  auto input =
      vulkan_struct<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  if (translucent_mesh) {  // spheres have no attributes: they are read from storage
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();
  }
  auto assembly = vulkan_struct<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = translucent_mesh ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
  // The place of a panel is set while it is recorded.
  constexpr std::array<VkDynamicState, 2> kPlaces = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  auto dynamic = vulkan_struct<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = static_cast<std::uint32_t>(kPlaces.size());
  dynamic.pDynamicStates = kPlaces.data();
  auto area = vulkan_struct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  area.viewportCount = 1;
  area.scissorCount = 1;
  auto raster =
      vulkan_struct<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.cullMode = translucent_mesh ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1;
  auto samples =
      vulkan_struct<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto depth =
      vulkan_struct<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = translucent_mesh ? VK_FALSE : VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendAttachmentState blend{};
  blend.blendEnable = translucent_mesh ? VK_TRUE : VK_FALSE;
  blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  blend.colorBlendOp = VK_BLEND_OP_ADD;
  blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  blend.alphaBlendOp = VK_BLEND_OP_ADD;
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
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blending;
  info.pDynamicState = &dynamic;
  info.layout = layout_;
  info.renderPass = pass_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(host_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  for (const VkPipelineShaderStageCreateInfo& stage : stages)
    vkDestroyShaderModule(host_.device, stage.module, nullptr);
  return pipeline;
}

void ForwardPass::draw_panel(VkCommandBuffer commands, std::size_t panel, const DrawnMesh& mesh) const {
  const auto left = static_cast<std::uint32_t>(panel) * panel_.width;
  const VkViewport viewport = {static_cast<float>(left),          0, static_cast<float>(panel_.width),
                               static_cast<float>(panel_.height), 0, 1};
  const VkRect2D scissor = {{static_cast<std::int32_t>(left), 0}, panel_};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
  const DrawnBalls& balls = balls_[panel];
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[panel]);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &sets_[panel], 0, nullptr);
  if (balls.arguments != VK_NULL_HANDLE) {
    vkCmdDrawIndirect(commands, balls.arguments, 0, 1, sizeof(medial_vk::RecordedCounts));
  } else {
    vkCmdDraw(commands, 4, balls.count, 0, 0);
  }
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, mesh_);
  vkCmdDrawIndexed(commands, mesh.index_count, 1, 0, 0, 0);
}

void ForwardPass::record(VkCommandBuffer commands, const FrameConstants& constants, const DrawnMesh& mesh,
                         VkBuffer pixels) const {
  std::array<VkClearValue, 2> clear{};
  clear[0].color = {{0.93f, 0.94f, 0.95f, 1}};
  clear[1].depthStencil = {1, 0};
  auto begin = vulkan_struct<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  begin.renderPass = pass_;
  begin.framebuffer = framebuffer_;
  begin.renderArea = {{0, 0}, size_};
  begin.clearValueCount = static_cast<std::uint32_t>(clear.size());
  begin.pClearValues = clear.data();
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdPushConstants(commands, layout_, kStages, 0, sizeof(constants), &constants);
  const VkDeviceSize zero = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &mesh.vertices, &zero);
  vkCmdBindIndexBuffer(commands, mesh.indices, 0, VK_INDEX_TYPE_UINT32);
  for (std::size_t panel = 0; panel < balls_.size(); ++panel) draw_panel(commands, panel, mesh);
  vkCmdEndRenderPass(commands);

  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {size_.width, size_.height, 1};
  vkCmdCopyImageToBuffer(commands, colour_.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels, 1, &region);
  auto seen = vulkan_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  seen.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  seen.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &seen, 0, nullptr, 0,
                       nullptr);
}
