// Records dispatches into a command buffer, straight-line: bind, dispatch, barrier. Never submits or waits.
#pragma once

#include <volk.h>

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "device/internals.h"
#include "device/program.h"
#include "device_commands/memory.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Descriptor pools and timestamp queries that a recorded command buffer needs until it has run.
class Recorder {
 public:
  /// `commands` must be in the recording state. Errors are kept for status(), to be called at the end.
  Recorder(ContextImpl& context, VkCommandBuffer commands);
  /// A rehearsal: records nothing, and lists the programs that the dispatches need.
  explicit Recorder(ContextImpl& context) : Recorder(context, VK_NULL_HANDLE) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();

  /// Runs `shader` over `items` invocations, rounded up to whole workgroups; those beyond the device's limit per
  /// dimension go to further rows (kernels: workgroup_index.glsl).
  void dispatch(const ProgramKey& key, std::span<const BufferRange> buffers, std::span<const VkBufferView> texels,
                std::span<const std::byte> push_constants, std::uint64_t items);
  /// The same with three group counts read from `arguments` at `offset`.
  void dispatch_indirect(const ProgramKey& key, std::span<const BufferRange> buffers,
                         std::span<const VkBufferView> texels, std::span<const std::byte> push_constants,
                         const Buffer& arguments, VkDeviceSize offset);
  /// Makes all writes so far visible to all later compute, indirect and transfer reads and writes.
  void barrier();
  void fill(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes, std::uint32_t word);
  /// At most 65,536 bytes, which are stored in the command buffer.
  void update(const Buffer& buffer, VkDeviceSize offset, std::span<const std::byte> bytes);
  void copy(const Buffer& from, VkDeviceSize from_offset, const Buffer& to, VkDeviceSize to_offset, VkDeviceSize bytes);
  /// Between the commands recorded here and any commands of a host before or after them.
  void barrier_to_others();
  /// Makes device writes visible to the host once the fence has signalled.
  void barrier_to_host();
  /// For a queue that can only copy: barriers are between copies, and nothing is measured.
  void only_transfer();
  /// No timestamps: stages have no times.
  void measure_nothing() { measures_ = false; }
  /// From here on, descriptor sets are kept for restart().
  void keep_sets() { keeps_sets_ = true; }
  /// Begins anew with other commands, as in the constructor, without the errors so far. Dispatches of the same programs
  /// with the same buffers, in the same order, then have the kept sets, and nothing is created for them. Preconditions:
  /// the commands before have finished, or are never submitted; nothing is measured.
  void restart(VkCommandBuffer commands);
  /// From here on, time counts for `stage`; times of the same stage add up. No-op without timestamps.
  void begin_stage(const std::string& stage);
  /// Ends the last stage. run_commands() does so; code that records into a buffer of its own calls this last.
  void end_stages();

  Status status() const { return status_; }
  /// After a rehearsal: the programs passed to dispatch(), each once.
  const std::set<ProgramKey>& programs() const { return programs_; }
  /// After the command buffer has finished: seconds per stage. Empty without timestamps. Errors: kInternal (device
  /// lost), kOutOfMemory.
  Result<std::vector<StageTime>> stage_times() const;

 private:
  /// A descriptor set, and what is bound in it.
  struct KeptSet {
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    std::vector<BufferRange> buffers;
    std::vector<VkBufferView> texels;
    VkDescriptorSet set = VK_NULL_HANDLE;
  };
  /// The set of the next dispatch: a kept one, or a new one. Null after an error.
  VkDescriptorSet set_for(VkDescriptorSetLayout layout, std::span<const BufferRange> buffers,
                          std::span<const VkBufferView> texels);
  VkDescriptorSet allocate_set(VkDescriptorSetLayout layout, std::uint32_t storage, std::uint32_t texels);
  bool rehearses() const { return commands_ == VK_NULL_HANDLE; }
  void bind(const ProgramKey& key, std::span<const BufferRange> buffers, std::span<const VkBufferView> texels,
            std::span<const std::byte> push_constants);
  void check_bindings(const ProgramKey& key, std::span<const BufferRange> buffers, std::span<const VkBufferView> texels,
                      std::span<const std::byte> push_constants);
  void write_set(VkDescriptorSet set, std::span<const BufferRange> buffers, std::span<const VkBufferView> texels);
  void add_descriptor_pool(std::uint32_t storage, std::uint32_t texels);
  void pipeline_barrier(VkPipelineStageFlags to_stages, VkAccessFlags to_access);
  // Of the queue. DRAW_INDIRECT is where group counts are read.
  static constexpr VkPipelineStageFlags kAllStages =
      VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  void write_timestamp();
  void fail(Error error);

  // The remaining capacity of the last descriptor pool.
  struct Room {
    std::uint32_t sets = 0;
    std::uint32_t storage = 0;
    std::uint32_t texels = 0;
  };

  ContextImpl* context_;
  VkCommandBuffer commands_;
  std::vector<VkDescriptorPool> descriptor_pools_;
  std::set<ProgramKey> programs_;
  Room room_;
  std::uint32_t next_pool_sets_ = 0;
  bool keeps_sets_ = false;
  std::vector<KeptSet> kept_sets_;  // in the order of the dispatches
  std::size_t next_set_ = 0;        // of them
  std::vector<VkQueryPool> timestamps_;
  std::size_t timestamp_count_ = 0;
  std::vector<std::string> stages_;
  VkPipelineStageFlags queue_stages_ = kAllStages;
  bool measures_ = true;
  Status status_;
};

/// Push constants from any trivially copyable struct.
template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

}  // namespace medial_vk
