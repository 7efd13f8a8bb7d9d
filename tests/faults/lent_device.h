// A host with a device of its own: that of another context, lent in the way of a host.
#pragma once

#include <string>
#include <utility>

#include "device_commands/memory.h"
#include "device_commands/recorder.h"
#include "fault_test.h"
#include "medial_vk/extraction_job.h"
#include "medial_vk/follower_job.h"
#include "medial_vk/proximity_job.h"
#include "support/device/lend_device.h"
#include "support/recorded_job.h"

namespace medial_vk::test {

class LentDevice {
 public:
  explicit LentDevice(Context owner) : owner_(std::move(owner)) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = impl().queue_family;
    EXPECT_EQ(impl().vk.vkCreateCommandPool(impl().device, &pool, nullptr, &pool_), VK_SUCCESS);
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool_;
    allocation.commandBufferCount = 1;
    EXPECT_EQ(impl().vk.vkAllocateCommandBuffers(impl().device, &allocation, &commands_), VK_SUCCESS);
    begin();
  }
  LentDevice(const LentDevice&) = delete;
  LentDevice& operator=(const LentDevice&) = delete;
  ~LentDevice() { impl().vk.vkDestroyCommandPool(impl().device, pool_, nullptr); }

  HostDevice lend(const VkAllocationCallbacks* callbacks = nullptr) {
    HostDevice host = lend_device(impl());
    host.allocation_callbacks = callbacks;
    return host;
  }

  /// The counts of the job, once it has been recorded and run. Calls of the host itself do not fail.
  Answer record_and_run(ExtractionJob& job) {
    const Status recorded = in_runtime([&] { return job.record(commands_); });
    VulkanInterposer::get().stop_failing();
    if (recorded.ok()) submit();
    begin();
    if (!recorded.ok()) return recorded.error();
    const RecordedCounts counts = job.counts();
    EXPECT_EQ(counts.complete, 1u);
    EXPECT_GT(counts.spheres, 0u);
    std::string out;
    append_bytes(out, counts);
    return out;
  }

  /// The verdicts of the job for its first `count` poses, likewise.
  Answer record_and_run(ProximityJob& job, std::uint32_t count) {
    return run_and_read(in_runtime([&] { return job.record(commands_, count); }), job.buffers().answers,
                        count * sizeof(std::uint32_t));
  }

  /// The balls of the job, of which there are `count`, likewise.
  Answer record_and_run(FollowerJob& job, std::uint32_t count) {
    return run_and_read(in_runtime([&] { return job.record(commands_); }), job.buffers().balls,
                        count * sizeof(RecordedBall));
  }

 private:
  Answer run_and_read(const Status& recorded, VkBuffer answers, VkDeviceSize bytes) {
    VulkanInterposer::get().stop_failing();
    Arena arena(impl());
    const Buffer read = arena.create_buffer(bytes, MemoryKind::kReadback, "a test").value();
    if (recorded.ok()) {
      Recorder reading(impl(), commands_);
      reading.copy({answers, bytes, nullptr}, 0, read, 0, bytes);
      reading.barrier_to_host();
      EXPECT_TRUE(reading.status().ok());
      submit();
    }
    begin();
    if (!recorded.ok()) return recorded.error();
    return std::string(static_cast<const char*>(read.mapped), bytes);
  }

  ContextImpl& impl() { return Internals::of(owner_); }

  void begin() {
    EXPECT_EQ(impl().vk.vkResetCommandBuffer(commands_, 0), VK_SUCCESS);
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    EXPECT_EQ(impl().vk.vkBeginCommandBuffer(commands_, &info), VK_SUCCESS);
  }

  void submit() {
    EXPECT_EQ(impl().vk.vkEndCommandBuffer(commands_), VK_SUCCESS);
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    EXPECT_EQ(impl().vk.vkQueueSubmit(impl().queue, 1, &info, VK_NULL_HANDLE), VK_SUCCESS);
    EXPECT_EQ(impl().vk.vkDeviceWaitIdle(impl().device), VK_SUCCESS);
  }

  Context owner_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

inline PreparedMesh sheared(PreparedMesh mesh) {
  for (Point& p : mesh.mesh.vertices) p[0] = 1.5 * p[0] + 0.25 * p[1];
  return mesh;
}

/// A job on a context of the host's device, the mesh moved, recorded and run.
inline Answer make_job_and_record(LentDevice& host, Context& context, const PreparedMesh& mesh,
                                  const PreparedMesh& moved) {
  Result<IndexedMesh> indexed = in_runtime([&] { return IndexedMesh::build(mesh.view()); });
  if (!indexed.ok()) return indexed.error();
  const auto create = [&] { return ExtractionJob::create(context, indexed.value(), small_job(Mode::kCertified)); };
  Result<ExtractionJob> job = in_runtime(create);
  if (!job.ok()) return job.error();
  const Status status = in_runtime([&] { return move(job.value(), indexed.value(), moved.view()); });
  if (!status.ok()) return status.error();
  return host.record_and_run(job.value());
}

}  // namespace medial_vk::test
