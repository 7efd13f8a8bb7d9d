#include "output/picture/vulkan/device_painter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "output/colours/colour_map.h"
#include "output/picture/vulkan/drawing_pipelines.h"

namespace medial_vk::picture {
namespace {

constexpr std::uint32_t kBorder =
    static_cast<std::uint32_t>(kGreatestReach) + 1;  // Pixels around a tile that may shade it.
constexpr std::uint32_t kTileSamples = 1024;         // Per side: 45 MiB of layers.
constexpr std::uint32_t kMarksAtOnce = 1u << 20;     // 48 MiB: every device can bind 128.
constexpr std::uint32_t kCornersOfMark = 6;

/// The scene in buffers of the device.
struct SceneBuffers {
  DrawingBuffer positions, normals, palette;
};

template <class T>
DrawingBuffer upload(DrawingDevice& device, const std::vector<T>& values, VkBufferUsageFlags usage,
                     std::size_t multiple = 1) {
  const std::size_t count = (std::max<std::size_t>(values.size(), 1) + multiple - 1) / multiple * multiple;
  const DrawingBuffer buffer = device.create_buffer(count * sizeof(T), usage);
  std::copy(values.begin(), values.end(), static_cast<T*>(buffer.mapped));
  return buffer;
}

/// Lists longer than one binding are padded to whole batches.
DrawingBuffer upload_marks(DrawingDevice& device, const std::vector<Mark>& marks) {
  return upload(device, marks, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, marks.size() > kMarksAtOnce ? kMarksAtOnce : 1);
}

}  // namespace

class DevicePainter::Impl {
 public:
  Impl(const DeviceDescription& description, const PainterOptions& options)
      : device_(description, options.validation, options.loader),
        samples_(options.samples != 0        ? options.samples
                 : description.type == "cpu" ? 2
                                             : 4),
        tile_({kTileSamples / samples_, kTileSamples / samples_}),
        layer_({(tile_.width + 2 * kBorder) * samples_, (tile_.height + 2 * kBorder) * samples_}),
        pipelines_(device_, layer_, tile_) {
    create_targets();
    create_commands();
    create_set();
  }

  void draw(const Scene& scene, std::span<const Panel> panels, const PictureView& view, Picture& picture) {
    const SceneBuffers buffers = upload_scene(scene);
    for (const Panel& panel : panels) {
      const Camera camera(scene.in_frame(), view, frame_of(panel, picture, samples_));
      const std::vector<Mark> marks = panel.balls ? panel_balls(scene, panel, view, picture) : scene.discs;
      write_set(upload_marks(device_, marks), buffers.palette);
      for (std::uint32_t top = 0; top < picture.height; top += tile_.height) {
        for (std::uint32_t left = 0; left < panel.width; left += tile_.width) {
          record(scene, buffers, panel, marks.size(), constants(scene, panel, camera, left, top, picture.height));
          submit();
          copy_pixels(panel, left, top, picture);
        }
      }
    }
  }

  std::uint64_t validation_messages() const { return device_.validation_messages(); }
  std::uint32_t samples() const { return samples_; }

 private:
  struct Layer {
    DrawingImage colour;
    VkFramebuffer target = VK_NULL_HANDLE;
  };

  VkFramebuffer create_framebuffer(VkRenderPass pass, VkExtent2D size, std::span<const VkImageView> views) {
    auto info = vulkan_struct<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    VkFramebuffer made = VK_NULL_HANDLE;
    DrawingDevice::check(device_.vk.CreateFramebuffer(device_.device, &info, nullptr, &made), "vkCreateFramebuffer");
    device_.at_end([this, made] { device_.vk.DestroyFramebuffer(device_.device, made, nullptr); });
    return made;
  }

  Layer create_layer(const DrawingImage& depth) {
    Layer layer;
    layer.colour =
        device_.create_image(layer_, kLayerFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                             VK_IMAGE_ASPECT_COLOR_BIT);
    layer.target = create_framebuffer(pipelines_.layer_pass, layer_, std::array{layer.colour.view, depth.view});
    return layer;
  }

  DrawingImage create_depth() {
    return device_.create_image(layer_, kDepthFormat,
                                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                VK_IMAGE_ASPECT_DEPTH_BIT);
  }

  void create_targets() {
    const DrawingImage wall_depth = create_depth();  // For both: each is finished with it when the next begins.
    mark_depth_ = create_depth();
    front_ = create_layer(wall_depth);
    back_ = create_layer(wall_depth);
    marks_ = create_layer(mark_depth_);
    pixels_ =
        device_.create_image(tile_, kPixelFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                             VK_IMAGE_ASPECT_COLOR_BIT);
    pixel_target_ = create_framebuffer(pipelines_.compose_pass, tile_, std::array{pixels_.view});
    read_back_ = device_.create_buffer(VkDeviceSize{4} * tile_.width * tile_.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  }

  void create_commands() {
    auto pool = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.queueFamilyIndex = device_.queue_family;
    DrawingDevice::check(device_.vk.CreateCommandPool(device_.device, &pool, nullptr, &pool_), "vkCreateCommandPool");
    device_.at_end([this] { device_.vk.DestroyCommandPool(device_.device, pool_, nullptr); });
    auto allocation = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    DrawingDevice::check(device_.vk.AllocateCommandBuffers(device_.device, &allocation, &commands_),
                         "vkAllocateCommandBuffers");
    const auto fence = vulkan_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    DrawingDevice::check(device_.vk.CreateFence(device_.device, &fence, nullptr, &finished_), "vkCreateFence");
    device_.at_end([this] { device_.vk.DestroyFence(device_.device, finished_, nullptr); });
  }

  void create_set() {
    const auto sampler = vulkan_struct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);  // nearest
    DrawingDevice::check(device_.vk.CreateSampler(device_.device, &sampler, nullptr, &sampler_), "vkCreateSampler");
    device_.at_end([this] { device_.vk.DestroySampler(device_.device, sampler_, nullptr); });
    const std::array<VkDescriptorPoolSize, 3> sizes = {{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, 1},
                                                        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1},
                                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4}}};
    auto pool = vulkan_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    VkDescriptorPool made = VK_NULL_HANDLE;
    DrawingDevice::check(device_.vk.CreateDescriptorPool(device_.device, &pool, nullptr, &made),
                         "vkCreateDescriptorPool");
    device_.at_end([this, made] { device_.vk.DestroyDescriptorPool(device_.device, made, nullptr); });
    auto allocation = vulkan_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocation.descriptorPool = made;
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &pipelines_.set_layout;
    DrawingDevice::check(device_.vk.AllocateDescriptorSets(device_.device, &allocation, &set_),
                         "vkAllocateDescriptorSets");
  }

  void write_set(const DrawingBuffer& marks, const DrawingBuffer& palette) {
    const VkDeviceSize most = VkDeviceSize{kMarksAtOnce} * sizeof(Mark);
    const VkDescriptorBufferInfo seen_marks = {marks.handle, 0, std::min(marks.bytes, most)};
    const VkDescriptorBufferInfo whole_palette = {palette.handle, 0, VK_WHOLE_SIZE};
    const auto colour = [this](const DrawingImage& image) {
      return VkDescriptorImageInfo{sampler_, image.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    };
    const std::array<VkDescriptorImageInfo, 4> images = {
        colour(front_.colour),
        colour(back_.colour),
        colour(marks_.colour),
        {sampler_, mark_depth_.view, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL}};
    std::array<VkWriteDescriptorSet, 3> writes{};
    for (VkWriteDescriptorSet& write : writes) {
      write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      write.dstSet = set_;
      write.descriptorCount = 1;
    }
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
    writes[0].pBufferInfo = &seen_marks;
    writes[1].dstBinding = 1;
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[1].pBufferInfo = &whole_palette;
    writes[2].dstBinding = 2;
    writes[2].descriptorCount = static_cast<std::uint32_t>(images.size());
    writes[2].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[2].pImageInfo = images.data();
    // The four images have a binding each: an update continues into the next bindings.
    device_.vk.UpdateDescriptorSets(device_.device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                    nullptr);
  }

  SceneBuffers upload_scene(const Scene& scene) {
    std::vector<std::array<float, 4>> palette;
    for (const Eigen::Vector3f& colour : scene.palette) {
      const Eigen::Vector3f light = to_light(colour);
      palette.push_back({light.x(), light.y(), light.z(), 1});
    }
    return {upload(device_, scene.mesh.positions, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
            upload(device_, scene.mesh.normals, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
            upload(device_, palette, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)};
  }

  PanelConstants constants(const Scene& scene, const Panel& panel, const Camera& camera, std::uint32_t left,
                           std::uint32_t top, std::uint32_t height) const {
    const auto samples = static_cast<float>(samples_), border = static_cast<float>(kBorder);
    const auto row = [&](Eigen::Index i, float w) {
      return std::array{camera.rotation()(i, 0), camera.rotation()(i, 1), camera.rotation()(i, 2), w};
    };
    PanelConstants c;
    c.right = row(0, camera.offset_x() - samples * (static_cast<float>(left) - border));
    c.up = row(1, camera.offset_y() - samples * (static_cast<float>(top) - border));
    c.towards = row(2, camera.pixels());
    c.layer = {static_cast<float>(layer_.width), static_cast<float>(layer_.height), samples, Camera::kDistance};
    c.depth = {Camera::least_nearness(), 1.0f / (Camera::greatest_nearness() - Camera::least_nearness()),
               kLeastDiscRadius * samples, kGreatestReach * samples};
    c.place = {static_cast<float>(top), static_cast<float>(height), border * samples, kReach};
    c.what = {panel.balls ? 1u : 0u, static_cast<std::uint32_t>(scene.palette.size()), left, 0};
    return c;
  }

  void begin_pass(VkRenderPass pass, VkFramebuffer target, VkExtent2D size, const VkClearColorValue& nothing,
                  float farthest) {
    std::array<VkClearValue, 2> clear{};
    clear[0].color = nothing;
    clear[1].depthStencil = {farthest, 0};
    auto begin = vulkan_struct<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass;
    begin.framebuffer = target;
    begin.renderArea = {{0, 0}, size};
    begin.clearValueCount = static_cast<std::uint32_t>(clear.size());
    begin.pClearValues = clear.data();
    device_.vk.CmdBeginRenderPass(commands_, &begin, VK_SUBPASS_CONTENTS_INLINE);
  }

  void record_wall(const Layer& layer, VkPipeline pipeline, float farthest, const Scene& scene, bool shown) {
    begin_pass(pipelines_.layer_pass, layer.target, layer_, {{0, 0, 0, 0}}, farthest);
    if (shown && !scene.mesh.positions.empty()) {
      device_.vk.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
      device_.vk.CmdDraw(commands_, static_cast<std::uint32_t>(scene.mesh.positions.size()), 1, 0, 0);
    }
    device_.vk.CmdEndRenderPass(commands_);
  }

  void bind_set(std::uint32_t offset) {
    device_.vk.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 0, 1, &set_, 1,
                                     &offset);
  }

  void record_marks(std::size_t marks, VkPipeline pipeline) {
    begin_pass(pipelines_.layer_pass, marks_.target, layer_, {{0, 0, 0, -1}}, 0);
    device_.vk.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    for (std::size_t first = 0; first < marks; first += kMarksAtOnce) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(marks - first, kMarksAtOnce));
      bind_set(static_cast<std::uint32_t>(first * sizeof(Mark)));
      device_.vk.CmdDraw(commands_, kCornersOfMark * count, 1, 0, 0);
    }
    device_.vk.CmdEndRenderPass(commands_);
  }

  void record_copy() {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {tile_.width, tile_.height, 1};
    device_.vk.CmdCopyImageToBuffer(commands_, pixels_.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, read_back_.handle,
                                    1, &copy);
    auto barrier = vulkan_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    device_.vk.CmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier,
                                  0, nullptr, 0, nullptr);
  }

  void record(const Scene& scene, const SceneBuffers& buffers, const Panel& panel, std::size_t marks,
              const PanelConstants& constants) {
    DrawingDevice::check(device_.vk.ResetCommandPool(device_.device, pool_, 0), "vkResetCommandPool");
    auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    DrawingDevice::check(device_.vk.BeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    device_.vk.CmdPushConstants(commands_, pipelines_.layout, kDrawingStages, 0, sizeof(constants), &constants);
    const std::array vertices = {buffers.positions.handle, buffers.normals.handle};
    const std::array<VkDeviceSize, 2> offsets = {0, 0};
    device_.vk.CmdBindVertexBuffers(commands_, 0, 2, vertices.data(), offsets.data());
    record_wall(front_, pipelines_.front, 0, scene, !panel.balls);
    record_wall(back_, pipelines_.back, 1, scene, !panel.balls);
    record_marks(marks, panel.balls ? pipelines_.balls : pipelines_.discs);
    begin_pass(pipelines_.compose_pass, pixel_target_, tile_, {{1, 1, 1, 1}}, 0);
    device_.vk.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.compose);
    bind_set(0);
    device_.vk.CmdDraw(commands_, 3, 1, 0, 0);
    device_.vk.CmdEndRenderPass(commands_);
    record_copy();
    DrawingDevice::check(device_.vk.EndCommandBuffer(commands_), "vkEndCommandBuffer");
  }

  void submit() {
    auto info = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    DrawingDevice::check(device_.vk.QueueSubmit(device_.queue, 1, &info, finished_), "vkQueueSubmit");
    DrawingDevice::check(device_.vk.WaitForFences(device_.device, 1, &finished_, VK_TRUE, UINT64_MAX),
                         "vkWaitForFences");
    DrawingDevice::check(device_.vk.ResetFences(device_.device, 1, &finished_), "vkResetFences");
  }

  void copy_pixels(const Panel& panel, std::uint32_t left, std::uint32_t top, Picture& picture) const {
    const std::uint32_t width = std::min(tile_.width, panel.width - left);
    const std::uint32_t height = std::min(tile_.height, picture.height - top);
    const auto* pixels = static_cast<const std::uint8_t*>(read_back_.mapped);
    for (std::uint32_t y = 0; y < height; ++y) {
      std::uint8_t* out = &picture.rgb[(std::size_t{top + y} * picture.width + panel.left + left) * 3];
      const std::uint8_t* in = pixels + std::size_t{4} * y * tile_.width;
      for (std::uint32_t x = 0; x < width; ++x) std::copy_n(in + 4 * x, 3, out + 3 * x);
    }
  }

  DrawingDevice device_;  // destroyed last: the others are destroyed through it
  std::uint32_t samples_;
  VkExtent2D tile_, layer_;  // pixels, samples
  DrawingPipelines pipelines_;
  Layer front_, back_, marks_;
  DrawingImage mark_depth_, pixels_;
  VkFramebuffer pixel_target_ = VK_NULL_HANDLE;
  DrawingBuffer read_back_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence finished_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

DevicePainter::DevicePainter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DevicePainter::DevicePainter(DevicePainter&&) noexcept = default;
DevicePainter::~DevicePainter() = default;

Result<DevicePainter> DevicePainter::open(const DeviceDescription& device, const PainterOptions& options) try {
  return DevicePainter(std::make_unique<Impl>(device, options));
} catch (const DrawingError& error) {
  return Error{ErrorCode::kNoDevice, error.what()};
}

Status DevicePainter::draw(const Scene& scene, std::span<const Panel> panels, const PictureView& view,
                           Picture& picture) try {
  impl_->draw(scene, panels, view, picture);
  return {};
} catch (const DrawingError& error) {
  return Error{ErrorCode::kNoDevice, error.what()};
}

std::uint32_t DevicePainter::samples() const { return impl_->samples(); }

std::uint64_t DevicePainter::validation_messages() const { return impl_->validation_messages(); }

}  // namespace medial_vk::picture
