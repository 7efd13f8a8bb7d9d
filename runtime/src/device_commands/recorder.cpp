#include "device_commands/recorder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "device/context_impl.h"
#include "gpu_types.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kFirstPoolSets = 32;
constexpr std::uint32_t kMaxPoolSets = 1024;

Error recording_error(const std::string& subject, const std::string& what) {
  return {ErrorCode::kInternal, "recording " + subject + ": " + what};
}

bool inside(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes) {
  return offset <= buffer.size && bytes <= buffer.size - offset;
}

std::string range_text(VkDeviceSize offset, VkDeviceSize bytes, const Buffer& buffer) {
  return std::to_string(bytes) + " bytes at " + std::to_string(offset) + " of a buffer of " +
         std::to_string(buffer.size);
}

}  // namespace

Recorder::Recorder(ContextImpl& context, VkCommandBuffer commands) : context_(&context), commands_(commands) {}

Recorder::~Recorder() {
  const VolkDeviceTable& vk = context_->vk;
  for (const VkDescriptorPool pool : descriptor_pools_) {
    vk.vkDestroyDescriptorPool(context_->device, pool, context_->allocation_callbacks);
  }
  for (const VkQueryPool pool : timestamps_) {
    vk.vkDestroyQueryPool(context_->device, pool, context_->allocation_callbacks);
  }
}

void Recorder::fail(Error error) {
  if (status_.ok()) status_ = std::move(error);  // the first error is the cause of those that follow
}

void Recorder::add_descriptor_pool(std::uint32_t storage, std::uint32_t texels) {
  // An estimate of 8 buffers per set: if a set has more, other sets of the pool are not used.
  next_pool_sets_ = std::clamp(next_pool_sets_ * 2, kFirstPoolSets, kMaxPoolSets);
  room_ = {next_pool_sets_, std::max(next_pool_sets_ * 8, storage), std::max(next_pool_sets_, texels)};
  const std::array<VkDescriptorPoolSize, 2> sizes = {
      {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, room_.storage}, {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, room_.texels}}};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = room_.sets;
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  descriptor_pools_.reserve(descriptor_pools_.size() + 1);  // so that no pool is lost
  const VkResult result =
      context_->vk.vkCreateDescriptorPool(context_->device, &info, context_->allocation_callbacks, &pool);
  if (result != VK_SUCCESS) {
    room_ = {};
    return fail(vulkan_error("vkCreateDescriptorPool", result));
  }
  descriptor_pools_.push_back(pool);
}

VkDescriptorSet Recorder::allocate_set(VkDescriptorSetLayout layout, std::uint32_t storage, std::uint32_t texels) {
  // The second attempt is in a new pool, since some drivers run out of memory before the counts are used up.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const bool fits = room_.sets >= 1 && room_.storage >= storage && room_.texels >= texels;
    if (!fits || attempt > 0) add_descriptor_pool(storage, texels);
    if (!status_.ok()) return VK_NULL_HANDLE;
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = descriptor_pools_.back();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = context_->vk.vkAllocateDescriptorSets(context_->device, &info, &set);
    if (result == VK_SUCCESS) {
      room_ = {room_.sets - 1, room_.storage - storage, room_.texels - texels};
      return set;
    }
    const bool pool_full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
    if (!pool_full || attempt > 0) fail(vulkan_error("vkAllocateDescriptorSets", result));
  }
  return VK_NULL_HANDLE;
}

void Recorder::check_bindings(const ProgramKey& key, std::span<const BufferRange> buffers,
                              std::span<const VkBufferView> texels, std::span<const std::byte> push_constants) {
  const auto expect = [&](const char* what, std::size_t given, std::size_t wanted) {
    if (given == wanted) return;
    fail(recording_error(key.shader,
                         std::to_string(given) + " " + what + " given, its program has " + std::to_string(wanted)));
  };
  expect("storage buffers", buffers.size(), key.storage_buffers);
  expect("texel buffers", texels.size(), key.texel_buffers);
  expect("bytes of push constants", push_constants.size(), key.push_constant_bytes);
  const VkDeviceSize alignment = context_->limits.minStorageBufferOffsetAlignment;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const BufferRange& range = buffers[i];
    const std::string subject = "binding " + std::to_string(i);
    if (range.buffer == VK_NULL_HANDLE || range.size == 0) {
      fail(recording_error(key.shader, subject + " is empty"));
    } else if (range.offset % alignment != 0) {
      fail(recording_error(key.shader, subject + " starts at byte " + std::to_string(range.offset) +
                                           ", not a multiple of " + std::to_string(alignment)));
    } else if (range.size != VK_WHOLE_SIZE && range.size > context_->limits.maxStorageBufferRange) {
      fail(recording_error(key.shader, subject + " has " + std::to_string(range.size) + " bytes, the limit is " +
                                           std::to_string(context_->limits.maxStorageBufferRange)));
    }
  }
  if (std::find(texels.begin(), texels.end(), VkBufferView{VK_NULL_HANDLE}) != texels.end()) {
    fail(recording_error(key.shader, "a texel buffer is empty"));
  }
}

void Recorder::write_set(VkDescriptorSet set, std::span<const BufferRange> buffers,
                         std::span<const VkBufferView> texels) {
  std::vector<VkDescriptorBufferInfo> ranges;
  for (const BufferRange& range : buffers) ranges.push_back({range.buffer, range.offset, range.size});
  std::vector<VkWriteDescriptorSet> writes(buffers.size() + texels.size());
  for (std::uint32_t i = 0; i < writes.size(); ++i) {
    VkWriteDescriptorSet& write = writes[i];
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = i;
    write.descriptorCount = 1;
    if (i < buffers.size()) {
      write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      write.pBufferInfo = &ranges[i];
    } else {
      write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
      write.pTexelBufferView = &texels[i - buffers.size()];
    }
  }
  context_->vk.vkUpdateDescriptorSets(context_->device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                      nullptr);
}

VkDescriptorSet Recorder::set_for(VkDescriptorSetLayout layout, std::span<const BufferRange> buffers,
                                  std::span<const VkBufferView> texels) {
  if (next_set_ < kept_sets_.size()) {
    const KeptSet& kept = kept_sets_[next_set_];
    if (kept.layout == layout && std::ranges::equal(kept.buffers, buffers) && std::ranges::equal(kept.texels, texels)) {
      return kept_sets_[next_set_++].set;
    }
    kept_sets_.resize(next_set_);  // the dispatches are others from here on
  }
  KeptSet made;
  if (keeps_sets_) {
    made.buffers.assign(buffers.begin(), buffers.end());
    made.texels.assign(texels.begin(), texels.end());
    kept_sets_.reserve(next_set_ + 1);  // so that no set is lost
  }
  made.layout = layout;
  made.set =
      allocate_set(layout, static_cast<std::uint32_t>(buffers.size()), static_cast<std::uint32_t>(texels.size()));
  if (!status_.ok()) return VK_NULL_HANDLE;
  write_set(made.set, buffers, texels);
  const VkDescriptorSet set = made.set;
  if (keeps_sets_) {
    kept_sets_.push_back(std::move(made));
    ++next_set_;
  }
  return set;
}

void Recorder::restart(VkCommandBuffer commands) {
  commands_ = commands;
  status_ = Status();
  next_set_ = 0;
}

void Recorder::bind(const ProgramKey& key, std::span<const BufferRange> buffers, std::span<const VkBufferView> texels,
                    std::span<const std::byte> push_constants) {
  check_bindings(key, buffers, texels, push_constants);
  if (!status_.ok()) return;
  if (rehearses()) {
    programs_.insert(key);
    return;
  }
  const Result<const Program*> program = context_->program(key);
  if (!program.ok()) return fail(program.error());
  const Program& bound = *program.value();
  const VkDescriptorSet set = set_for(bound.set_layout, buffers, texels);
  if (!status_.ok()) return;
  const VolkDeviceTable& vk = context_->vk;
  vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, bound.pipeline);
  vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, bound.layout, 0, 1, &set, 0, nullptr);
  if (!push_constants.empty()) {
    vk.vkCmdPushConstants(commands_, bound.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, key.push_constant_bytes,
                          push_constants.data());
  }
}

void Recorder::dispatch(const ProgramKey& key, std::span<const BufferRange> buffers,
                        std::span<const VkBufferView> texels, std::span<const std::byte> push_constants,
                        std::uint64_t items) {
  if (items == 0 || !status_.ok()) return;
  bind(key, buffers, texels, push_constants);
  if (!status_.ok() || rehearses()) return;
  const std::uint64_t groups = items / key.workgroup_size + (items % key.workgroup_size != 0 ? 1 : 0);
  const std::uint64_t per_row =
      std::min<std::uint64_t>({groups, gpu::kGroupsInRow, context_->limits.maxComputeWorkGroupCount[0]});
  const std::uint64_t rows = groups / per_row + (groups % per_row != 0 ? 1 : 0);
  if (rows > context_->limits.maxComputeWorkGroupCount[1]) {
    return fail(recording_error(key.shader, std::to_string(items) + " items are more than one dispatch can run"));
  }
  context_->vk.vkCmdDispatch(commands_, static_cast<std::uint32_t>(per_row), static_cast<std::uint32_t>(rows), 1);
}

void Recorder::dispatch_indirect(const ProgramKey& key, std::span<const BufferRange> buffers,
                                 std::span<const VkBufferView> texels, std::span<const std::byte> push_constants,
                                 const Buffer& arguments, VkDeviceSize offset) {
  if (!status_.ok()) return;
  if (offset % 4 != 0 || !inside(arguments, offset, sizeof(VkDispatchIndirectCommand))) {
    return fail(recording_error(key.shader, "group counts at byte " + std::to_string(offset) + " of a buffer of " +
                                                std::to_string(arguments.size)));
  }
  bind(key, buffers, texels, push_constants);
  if (!status_.ok() || rehearses()) return;
  context_->vk.vkCmdDispatchIndirect(commands_, arguments.handle, offset);
}

void Recorder::only_transfer() {
  queue_stages_ = VK_PIPELINE_STAGE_TRANSFER_BIT;
  measure_nothing();
}

void Recorder::pipeline_barrier(VkPipelineStageFlags to_stages, VkAccessFlags to_access) {
  if (rehearses()) return;
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  if (queue_stages_ == kAllStages) barrier.srcAccessMask |= VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = to_access;
  // Later commands must not overwrite data that earlier ones read, such as group counts.
  context_->vk.vkCmdPipelineBarrier(commands_, queue_stages_, to_stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Recorder::barrier() {
  constexpr VkAccessFlags kCopies = VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  constexpr VkAccessFlags kAll =
      kCopies | VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  pipeline_barrier(queue_stages_, queue_stages_ == kAllStages ? kAll : kCopies);
}

void Recorder::barrier_to_host() { pipeline_barrier(VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT); }

void Recorder::barrier_to_others() {
  if (rehearses()) return;
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  context_->vk.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                    0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Recorder::fill(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes, std::uint32_t word) {
  if (bytes == VK_WHOLE_SIZE && offset <= buffer.size) bytes = buffer.size - offset;
  if (bytes == 0 || !status_.ok()) return;
  if (offset % 4 != 0 || bytes % 4 != 0 || !inside(buffer, offset, bytes)) {
    return fail(recording_error("a fill", range_text(offset, bytes, buffer)));
  }
  if (rehearses()) return;
  context_->vk.vkCmdFillBuffer(commands_, buffer.handle, offset, bytes, word);
}

void Recorder::update(const Buffer& buffer, VkDeviceSize offset, std::span<const std::byte> bytes) {
  if (bytes.empty() || !status_.ok()) return;
  if (offset % 4 != 0 || bytes.size() % 4 != 0 || bytes.size() > 65536 || !inside(buffer, offset, bytes.size())) {
    return fail(recording_error("an update", range_text(offset, bytes.size(), buffer)));
  }
  if (rehearses()) return;
  context_->vk.vkCmdUpdateBuffer(commands_, buffer.handle, offset, bytes.size(), bytes.data());
}

void Recorder::copy(const Buffer& from, VkDeviceSize from_offset, const Buffer& to, VkDeviceSize to_offset,
                    VkDeviceSize bytes) {
  if (bytes == 0 || !status_.ok()) return;
  if (!inside(from, from_offset, bytes)) {
    return fail(recording_error("a copy from", range_text(from_offset, bytes, from)));
  }
  if (!inside(to, to_offset, bytes)) return fail(recording_error("a copy to", range_text(to_offset, bytes, to)));
  if (rehearses()) return;
  const VkBufferCopy region = {from_offset, to_offset, bytes};
  context_->vk.vkCmdCopyBuffer(commands_, from.handle, to.handle, 1, &region);
}

}  // namespace medial_vk
