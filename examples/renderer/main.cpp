// A renderer with its own Vulkan device, on which medial-vk computes: in every frame the mesh deforms, balls inside it
// are found for it, and they are drawn from the buffers of the job. None of them is copied to the host.
//   renderer FOLDER [FRAMES [WAY]]     writes frame-0.png and so on to FOLDER (default: 4 frames, at least 2)
// WAY is
//   follow   (default) the medial spheres of the first frame follow the mesh (FollowerJob)
//   search   the medial spheres are searched anew in each frame (ExtractionJob)
//   both     searched anew in the left half of the picture, followed in the right half
// The exit code is 1 if the validation layer, where installed, reports anything.
#include <medial_vk/host_device.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "balls_of_frames.h"
#include "camera.h"
#include "deforming_torus.h"
#include "device_times.h"
#include "forward_pass.h"
#include "vulkan_host.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace {

constexpr VkExtent2D kPanel = {960, 720};
constexpr std::uint32_t kFramesInFlight = 2;
constexpr std::uint32_t kAround = 64, kAlong = 125;  // 16,000 triangles

struct Ways {
  bool search = false, follow = false;
};

// The objects of one frame in flight.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence finished = VK_NULL_HANDLE;
  HostBuffer vertices, pixels;
  int number = -1;  // the frame in progress, or none
};

class Renderer {
 public:
  Renderer(std::string folder, const Ways& ways)
      : folder_(std::move(folder)),
        torus_(kAround, kAlong),
        context_(take(medial_vk::Context::adopt(adopted()))),
        rest_(take(medial_vk::IndexedMesh::build(torus_.view()))) {
    if (ways.search) searched_.emplace(context_, rest_, kFramesInFlight);
    if (ways.follow) followed_.emplace(host_, context_, rest_, kFramesInFlight);
    std::vector<DrawnBalls> balls;
    if (searched_) balls.push_back(searched_balls(searched_->job().buffers()));
    if (followed_) balls.push_back(followed_balls(followed_->job().buffers(), followed_->angles(), followed_->count()));
    pass_.emplace(host_, kPanel, balls);
    times_.emplace(host_, kFramesInFlight, static_cast<std::uint32_t>(balls.size()) + 1);
    auto pool = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = host_.queue_family;
    ::check(vkCreateCommandPool(host_.device, &pool, nullptr, &pool_), "vkCreateCommandPool");
    indices_ = host_.create_buffer(4 * torus_.index_count(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    torus_.write_indices(static_cast<std::uint32_t*>(indices_.mapped));
    for (Frame& frame : frames_) create(frame);
  }

  ~Renderer() {
    vkDeviceWaitIdle(host_.device);
    for (Frame& frame : frames_) {
      vkDestroyFence(host_.device, frame.finished, nullptr);
      host_.destroy(frame.vertices);
      host_.destroy(frame.pixels);
    }
    host_.destroy(indices_);
    vkDestroyCommandPool(host_.device, pool_, nullptr);
  }

  void draw(int frames) {
    for (int number = 0; number < frames; ++number) {
      finish(slot_of(number));
      submit(slot_of(number), number, static_cast<double>(number) / frames);
    }
    for (int i = 0; i < static_cast<int>(kFramesInFlight); ++i) finish(slot_of(frames + i));
    if (searched_) searched_->count();
    report(frames);
  }

  unsigned validation_messages() const { return host_.validation_messages(); }

 private:
  medial_vk::HostDevice adopted() const {
    medial_vk::HostDevice host;
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    host.instance = host_.instance;
    host.physical_device = host_.physical_device;
    host.device = host_.device;
    host.queue = host_.queue;
    host.queue_family = host_.queue_family;
    host.enabled_features = host_.features;
    return host;
  }

  void create(Frame& frame) {
    auto allocation = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    ::check(vkAllocateCommandBuffers(host_.device, &allocation, &frame.commands), "vkAllocateCommandBuffers");
    const auto fence = vulkan_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    ::check(vkCreateFence(host_.device, &fence, nullptr, &frame.finished), "vkCreateFence");
    frame.vertices = host_.create_buffer(24 * torus_.vertex_count(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    frame.pixels = host_.create_buffer(pass_->pixel_bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  }

  std::uint32_t slot_of(int number) const { return static_cast<std::uint32_t>(number) % kFramesInFlight; }

  void submit(std::uint32_t slot, int number, double phase) {
    Frame& frame = frames_[slot];
    torus_.deform(phase);
    torus_.write_vertices(static_cast<float*>(frame.vertices.mapped));
    const std::span<const medial_vk::Point> vertices = torus_.view().vertices;
    const auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    ::check(vkBeginCommandBuffer(frame.commands, &begin), "vkBeginCommandBuffer");
    FrameConstants constants = camera(kPanel);
    times_->mark(frame.commands, slot);
    if (searched_) {
      if (number >= static_cast<int>(kFramesInFlight)) searched_->count();
      searched_->record(frame.commands, vertices);
      const medial_vk::Placement placement = searched_->job().placement();
      for (std::size_t k = 0; k < 3; ++k) constants.placement[k] = static_cast<float>(placement.origin[k]);
      constants.placement[3] = static_cast<float>(placement.scale);
      times_->mark(frame.commands, slot);
    }
    if (followed_) {
      followed_->record(frame.commands, vertices);
      times_->mark(frame.commands, slot);
    }
    pass_->record(frame.commands, constants,
                  {frame.vertices.handle, indices_.handle, static_cast<std::uint32_t>(torus_.index_count())},
                  frame.pixels.handle);
    times_->mark(frame.commands, slot);
    ::check(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
    auto info = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &frame.commands;
    ::check(vkQueueSubmit(host_.queue, 1, &info, frame.finished), "vkQueueSubmit");
    frame.number = number;
  }

  // Waits for a frame in progress, and writes its file.
  void finish(std::uint32_t slot) {
    Frame& frame = frames_[slot];
    if (frame.number < 0) return;
    ::check(vkWaitForFences(host_.device, 1, &frame.finished, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    ::check(vkResetFences(host_.device, 1, &frame.finished), "vkResetFences");
    times_->add(slot);
    const std::string file = folder_ + "/frame-" + std::to_string(frame.number) + ".png";
    const auto width = static_cast<int>(pass_->size().width), height = static_cast<int>(pass_->size().height);
    if (stbi_write_png(file.c_str(), width, height, 4, frame.pixels.mapped, 4 * width) == 0)
      fail(("cannot write " + file).c_str());
    frame.number = -1;
  }

  void report(int frames) const {
    std::printf("%d frames of %zu triangles on %s; milliseconds of each:\n", frames, torus_.index_count() / 3,
                context_.device().name.c_str());
    std::uint32_t part = 0;
    if (searched_) report("search", searched_->spheres(), searched_->times(), times_->mean(part++), frames);
    if (followed_) report("follow", followed_->count(), followed_->times(), times_->mean(part++), frames);
    std::printf("draw: device %s\n", in_words(times_->mean(part)).c_str());
    if (host_.validates()) {
      std::printf("%u validation messages\n", host_.validation_messages());
    } else {
      std::printf("no validation layer is installed: nothing was validated\n");
    }
  }

  static std::string in_words(double device) {
    if (device < 0) return "not measured";
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", device);
    return text;
  }

  static void report(const char* way, std::uint32_t balls, const HostTimes& host, double device, int frames) {
    std::printf("%s: %u balls, moving the mesh %.1f, recording %.1f, device %s\n", way, balls,
                1e3 * host.moving.count() / frames, 1e3 * host.recording.count() / frames, in_words(device).c_str());
  }

  std::string folder_;
  DeformingTorus torus_;
  VulkanHost host_;
  medial_vk::Context context_;
  medial_vk::IndexedMesh rest_;
  std::optional<SearchedBalls> searched_;
  std::optional<FollowedBalls> followed_;
  std::optional<ForwardPass> pass_;
  std::optional<DeviceTimes> times_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  HostBuffer indices_;
  std::array<Frame, kFramesInFlight> frames_;
};

std::optional<Ways> ways_of(std::string_view word) {
  if (word == "follow") return Ways{false, true};
  if (word == "search") return Ways{true, false};
  if (word == "both") return Ways{true, true};
  return std::nullopt;
}

// At least two: the job of the search reports on a frame when the next but one is due.
std::optional<int> frames_of(std::string_view word) {
  int frames = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), frames);
  if (error != std::errc() || end != word.data() + word.size() || frames < static_cast<int>(kFramesInFlight)) {
    return std::nullopt;
  }
  return frames;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Ways> ways = ways_of(argc > 3 ? argv[3] : "follow");
  const std::optional<int> frames = frames_of(argc > 2 ? argv[2] : "4");
  if (argc < 2 || argc > 4 || !ways || !frames) {
    std::fprintf(stderr, "usage: renderer FOLDER [FRAMES [follow|search|both]]; FRAMES is 2 or more\n");
    return 2;
  }
  Renderer renderer(argv[1], *ways);
  renderer.draw(*frames);
  return renderer.validation_messages() == 0 ? 0 : 1;
}
