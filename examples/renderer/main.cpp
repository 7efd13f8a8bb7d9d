// A renderer with its own Vulkan device, on which medial-vk computes: in every frame the mesh deforms, the medial
// spheres are found again, and they are drawn from the buffer of the job. None of them is copied to the host.
//   renderer FOLDER [FRAMES]     writes frame-0.png and so on to FOLDER (default: 4 frames, at least 2)
// The exit code is 1 if the validation layer, where installed, reports anything.
#include <medial_vk/extraction_job.h>
#include <medial_vk/host_device.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "deforming_torus.h"
#include "forward_pass.h"
#include "vulkan_host.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace {

constexpr VkExtent2D kSize = {960, 720};
constexpr std::uint32_t kFramesInFlight = 2;
constexpr std::uint32_t kAround = 64, kAlong = 125;  // 16,000 triangles
constexpr std::uint32_t kResolution = 200;           // voxels along the longest side: some 20,000 spheres

using Seconds = std::chrono::duration<double>;
using Clock = std::chrono::steady_clock;

void check(const medial_vk::Status& status) {
  if (!status) fail(status.error().message.c_str());
}

template <class T>
T take(medial_vk::Result<T> result) {
  if (!result) fail(result.error().message.c_str());
  return std::move(result).value();
}

// A camera that looks at the origin: columns of perspective times view, depth 0 to 1, y down.
FrameConstants camera(const medial_vk::Placement& placement) {
  constexpr float kFar = 10, kNear = 0.1f, kZoom = 2.4f, kDistance = 3.6f, kHeight = 0.62f;  // kHeight: sine
  constexpr float kRaised = 0.2f;  // the near part appears larger
  const float across = std::sqrt(1 - kHeight * kHeight);
  const float aspect = static_cast<float>(kSize.width) / static_cast<float>(kSize.height);
  const float eye[3] = {0, -kDistance * across, kDistance * kHeight};
  const float axes[3][3] = {{1, 0, 0}, {0, kHeight, across}, {0, across, -kHeight}};  // right, up, ahead
  FrameConstants c{};
  for (int column = 0; column < 4; ++column) {
    float seen[3];
    for (int i = 0; i < 3; ++i) {
      seen[i] = column < 3 ? axes[i][column] : -(axes[i][0] * eye[0] + axes[i][1] * eye[1] + axes[i][2] * eye[2]);
    }
    float* out = c.to_clip + 4 * column;
    out[0] = kZoom / aspect * seen[0];
    out[1] = -kZoom * seen[1] - kRaised * seen[2];
    out[2] = kFar / (kFar - kNear) * (seen[2] - (column == 3 ? kNear : 0));
    out[3] = seen[2];
  }
  for (int k = 0; k < 3; ++k) {
    c.eye[k] = eye[k];
    c.placement[k] = static_cast<float>(placement.origin[k]);
  }
  c.placement[3] = static_cast<float>(placement.scale);
  return c;
}

// The objects of one frame in flight.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence finished = VK_NULL_HANDLE;
  HostBuffer vertices, pixels;
  int number = -1;  // the frame in progress, or none
};

class Renderer {
 public:
  explicit Renderer(std::string folder)
      : folder_(std::move(folder)),
        torus_(kAround, kAlong),
        context_(take(medial_vk::Context::adopt(adopted()))),
        mesh_(take(medial_vk::IndexedMesh::build(torus_.view()))),
        job_(take(medial_vk::ExtractionJob::create(context_, mesh_, options(), {kFramesInFlight, 4}))),
        pass_(host_, kSize, job_.buffers()) {
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
      Frame& frame = frames_[static_cast<std::size_t>(number) % frames_.size()];
      finish(frame);
      submit(frame, number, static_cast<double>(number) / frames);
    }
    for (int i = 0; i < static_cast<int>(kFramesInFlight); ++i)
      finish(frames_[static_cast<std::size_t>(frames + i) % frames_.size()]);
    count_spheres();
    std::printf("%d frames of %zu triangles and %u spheres on %s; moving the mesh %.1f ms a frame, recording %.1f ms\n",
                frames, torus_.index_count() / 3, spheres_, context_.device().name.c_str(),
                1e3 * moving_.count() / frames, 1e3 * recording_.count() / frames);
    if (host_.validates()) {
      std::printf("%u validation messages\n", host_.validation_messages());
    } else {
      std::printf("no validation layer is installed: nothing was validated\n");
    }
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

  static medial_vk::ExtractionOptions options() {
    medial_vk::ExtractionOptions p;
    p.resolution = kResolution;
    return p;
  }

  void create(Frame& frame) {
    auto allocation = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    ::check(vkAllocateCommandBuffers(host_.device, &allocation, &frame.commands), "vkAllocateCommandBuffers");
    const auto fence = vulkan_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    ::check(vkCreateFence(host_.device, &fence, nullptr, &frame.finished), "vkCreateFence");
    frame.vertices = host_.create_buffer(24 * torus_.vertex_count(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    frame.pixels = host_.create_buffer(pass_.pixel_bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  }

  void submit(Frame& frame, int number, double phase) {
    const auto start = Clock::now();
    torus_.deform(phase);
    torus_.write_vertices(static_cast<float*>(frame.vertices.mapped));
    if (number >= static_cast<int>(kFramesInFlight)) count_spheres();
    check(mesh_.move_vertices(torus_.view().vertices));
    check(job_.update(mesh_));
    const auto moved = Clock::now();
    const auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    ::check(vkBeginCommandBuffer(frame.commands, &begin), "vkBeginCommandBuffer");
    check(job_.record(frame.commands));
    recording_ += Clock::now() - moved;
    moving_ += moved - start;
    pass_.record(frame.commands, camera(job_.placement()),
                 {frame.vertices.handle, indices_.handle, static_cast<std::uint32_t>(torus_.index_count())},
                 job_.buffers(), frame.pixels.handle);
    ::check(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
    auto info = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &frame.commands;
    ::check(vkQueueSubmit(host_.queue, 1, &info, frame.finished), "vkQueueSubmit");
    frame.number = number;
  }

  // For the oldest frame, which has finished: six words of the job for the host.
  void count_spheres() {
    const medial_vk::RecordedCounts counts = job_.counts();
    if (counts.complete == 0) fail("the job's memory is too small for the spheres");
    spheres_ = counts.spheres;
  }

  // Waits for a frame in progress, and writes its file.
  void finish(Frame& frame) {
    if (frame.number < 0) return;
    ::check(vkWaitForFences(host_.device, 1, &frame.finished, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    ::check(vkResetFences(host_.device, 1, &frame.finished), "vkResetFences");
    const std::string file = folder_ + "/frame-" + std::to_string(frame.number) + ".png";
    if (stbi_write_png(file.c_str(), kSize.width, kSize.height, 4, frame.pixels.mapped, 4 * kSize.width) == 0)
      fail(("cannot write " + file).c_str());
    frame.number = -1;
  }

  std::string folder_;
  DeformingTorus torus_;
  VulkanHost host_;
  medial_vk::Context context_;
  medial_vk::IndexedMesh mesh_;
  medial_vk::ExtractionJob job_;
  ForwardPass pass_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  HostBuffer indices_;
  std::array<Frame, kFramesInFlight> frames_;
  std::uint32_t spheres_ = 0;
  Seconds moving_{}, recording_{};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: renderer FOLDER [FRAMES]\n");
    return 2;
  }
  Renderer renderer(argv[1]);
  // At least two: the job reports on a frame when the next but one is due.
  renderer.draw(argc == 3 ? std::max(static_cast<int>(kFramesInFlight), std::atoi(argv[2])) : 4);
  return renderer.validation_messages() == 0 ? 0 : 1;
}
