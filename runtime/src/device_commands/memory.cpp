#include "device_commands/memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <utility>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

constexpr VkDeviceSize kMinBlockBytes = 1ull << 20;
// Two chunks of a mesh, of 4 MiB each, and 4 MiB for points, counters and the word that stops a job.
constexpr VkDeviceSize kBytesOnTheWay = 12ull << 20;
constexpr VkDeviceSize kMaxBlockBytes = 64ull << 20;
constexpr VkDeviceSize kTexelBytes = 16;  // RGBA32F, RGBA32UI

const char* kind_name(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::kDevice:
    case MemoryKind::kTexels:
      return "device";
    case MemoryKind::kUpload:
      return "upload";
    case MemoryKind::kReadback:
      return "readback";
  }
  return "";
}

/// The suitability of a memory type, 0: not usable.
int suitability(VkMemoryPropertyFlags flags, MemoryKind kind, bool unified) {
  // Types that require a feature or an extension which the library does not enable, or that have other purposes.
  constexpr VkMemoryPropertyFlags kNever = VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT | VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                           VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD |
                                           VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD |
                                           VK_MEMORY_PROPERTY_RDMA_CAPABLE_BIT_NV;
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if ((flags & kNever) != 0) return 0;
  const bool local = (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
  const bool mappable = (flags & kMappable) == kMappable;
  const bool cached = (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
  switch (kind) {
    case MemoryKind::kDevice:
    case MemoryKind::kTexels:
      // Where host and device share their memory, mapping saves the copies. On a discrete device the mappable part of
      // the local memory may be a small window (256 MiB) that others need too.
      return local ? (mappable == unified ? 2 : 1) : 0;
    case MemoryKind::kUpload:
      return mappable ? (local && !unified ? 1 : 2) : 0;
    case MemoryKind::kReadback:
      return mappable ? (cached ? 2 : 1) : 0;
  }
  return 0;
}

/// The most suitable of the types in `allowed`; among equals the first, since drivers list the faster ones first.
/// -1: none.
int find_memory_type(const ContextImpl& context, std::uint32_t allowed, MemoryKind kind) {
  const bool unified = context.description.type == "cpu" || context.description.type == "integrated";
  int best = -1;
  int best_suitability = 0;
  for (std::uint32_t i = 0; i < context.memory.memoryTypeCount; ++i) {
    if ((allowed >> i & 1u) == 0) continue;
    const int suits = suitability(context.memory.memoryTypes[i].propertyFlags, kind, unified);
    if (suits > best_suitability) {
      best = static_cast<int>(i);
      best_suitability = suits;
    }
  }
  return best;
}

/// After this, the next push_back() cannot fail: a handle that it did not store would be lost.
template <class T>
void make_room(std::vector<T>& values) {
  if (values.size() == values.capacity()) values.reserve(std::max<std::size_t>(8, 2 * values.size()));
}

VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

/// "8388608 bytes of device memory for the contact lists: WHY"
Error memory_error(VkDeviceSize bytes, MemoryKind kind, const char* purpose, const std::string& why) {
  return {ErrorCode::kOutOfMemory, "cannot allocate " + std::to_string(bytes) + " bytes of " + kind_name(kind) +
                                       " memory for " + purpose + ": " + why};
}

struct Requirements {
  VkDeviceSize size = 0;
  VkDeviceSize alignment = 1;
  std::uint32_t types = 0;
  bool dedicated = false;
};

Requirements requirements_of(const ContextImpl& context, VkBuffer buffer) {
  VkMemoryDedicatedRequirements dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS;
  VkMemoryRequirements2 requirements{};
  requirements.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2;
  requirements.pNext = &dedicated;
  VkBufferMemoryRequirementsInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2;
  info.buffer = buffer;
  context.vk.vkGetBufferMemoryRequirements2(context.device, &info, &requirements);
  const VkMemoryRequirements& found = requirements.memoryRequirements;
  return {found.size, found.alignment, found.memoryTypeBits,
          dedicated.requiresDedicatedAllocation == VK_TRUE || dedicated.prefersDedicatedAllocation == VK_TRUE};
}

VkResult create_handle(const ContextImpl& context, VkDeviceSize size, VkBuffer* handle) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;  // of a host that draws the results
  if (size <= context.limits.maxTexelBufferElements * kTexelBytes) {
    info.usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  }
  // Buffers have no layouts that depend on the queue: sharing costs nothing, and avoids ownership transfers.
  const std::array<std::uint32_t, 2> families = {context.queue_family, context.transfer_family};
  if (context.transfer_queue != VK_NULL_HANDLE) {
    info.sharingMode = VK_SHARING_MODE_CONCURRENT;
    info.queueFamilyIndexCount = static_cast<std::uint32_t>(families.size());
    info.pQueueFamilyIndices = families.data();
  }
  return context.vk.vkCreateBuffer(context.device, &info, context.allocation_callbacks, handle);
}

}  // namespace

VkDeviceSize bytes_on_the_way(const ContextImpl& context) {
  const int type = find_memory_type(context, 0xffffffffu, MemoryKind::kDevice);
  const VkMemoryPropertyFlags flags = type < 0 ? 0 : context.memory.memoryTypes[type].propertyFlags;
  return (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0 ? 0 : kBytesOnTheWay;
}

std::uint64_t bytes_of_compiler(const ContextImpl& context, std::uint64_t budget) {
  constexpr std::uint64_t kMost = 96ull << 20;
  const bool takes_much = context.description.type == "cpu" && !context.is_llvmpipe;
  return takes_much ? std::min(kMost, budget / 8) : 0;
}

Arena::Arena(Arena&& other) noexcept
    : context_(other.context_),
      blocks_(std::move(other.blocks_)),
      buffers_(std::move(other.buffers_)),
      views_(std::move(other.views_)),
      bytes_(std::exchange(other.bytes_, 0)) {
  other.blocks_.clear();
  other.buffers_.clear();
  other.views_.clear();
}

Arena& Arena::operator=(Arena&& other) noexcept {
  if (this != &other) {
    release();
    context_ = other.context_;
    blocks_.swap(other.blocks_);
    buffers_.swap(other.buffers_);
    views_.swap(other.views_);
    std::swap(bytes_, other.bytes_);
  }
  return *this;
}

Arena::~Arena() { release(); }

void Arena::release() {
  const VolkDeviceTable& vk = context_->vk;
  for (const VkBufferView view : views_) {
    vk.vkDestroyBufferView(context_->device, view, context_->allocation_callbacks);
  }
  for (const VkBuffer buffer : buffers_) {
    vk.vkDestroyBuffer(context_->device, buffer, context_->allocation_callbacks);
  }
  for (const Block& block : blocks_) {  // freeing unmaps
    vk.vkFreeMemory(context_->device, block.memory, context_->allocation_callbacks);
  }
  views_.clear();
  buffers_.clear();
  blocks_.clear();
  bytes_ = 0;
}

Result<Buffer> Arena::create_buffer(VkDeviceSize bytes, MemoryKind kind, const char* purpose) {
  constexpr VkDeviceSize kAddressable = VkDeviceSize{1} << 62;  // so that rounding up cannot overflow
  const VkDeviceSize largest = std::min<VkDeviceSize>(context_->max_allocation_bytes, kAddressable);
  if (bytes > largest) {
    return memory_error(
        bytes, kind, purpose,
        "the device allocates at most " + std::to_string(largest) + " bytes at once (maxMemoryAllocationSize)");
  }
  Buffer buffer;
  buffer.size = std::max<VkDeviceSize>(align_up(bytes, 16), 16);
  if (kind == MemoryKind::kDevice && buffer.size > context_->limits.maxStorageBufferRange) {
    return memory_error(bytes, kind, purpose,
                        "kernels of this device see at most " + std::to_string(context_->limits.maxStorageBufferRange) +
                            " bytes of a buffer (maxStorageBufferRange)");
  }
  make_room(buffers_);
  const VkResult result = create_handle(*context_, buffer.size, &buffer.handle);
  if (result != VK_SUCCESS) return memory_error(bytes, kind, purpose, vulkan_error("vkCreateBuffer", result).message);
  buffers_.push_back(buffer.handle);
  Result<void*> bound = bind_memory(buffer, kind, purpose);
  if (!bound.ok()) {
    context_->vk.vkDestroyBuffer(context_->device, buffer.handle, context_->allocation_callbacks);
    buffers_.pop_back();
    return bound.error();
  }
  buffer.mapped = bound.value();
  return buffer;
}

Result<void*> Arena::bind_memory(const Buffer& buffer, MemoryKind kind, const char* purpose) {
  const Requirements needs = requirements_of(*context_, buffer.handle);
  const int type = find_memory_type(*context_, needs.types, kind);
  if (type < 0) return memory_error(buffer.size, kind, purpose, "the device has no such memory");

  const auto memory_type = static_cast<std::uint32_t>(type);
  const bool own_block = needs.dedicated || needs.size > kMaxBlockBytes / 4;
  Block* block = own_block ? nullptr : find_room(memory_type, needs.size, needs.alignment);
  if (block == nullptr) {
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (!own_block) {
      // Blocks grow with the memory of a type that the arena holds, so that a small job does not take much, nor a large
      // one much of a type that it hardly uses. A full device may still have room for the buffer alone.
      VkDeviceSize grown = std::clamp(std::bit_ceil(held(memory_type)), kMinBlockBytes, kMaxBlockBytes);
      if (expected_ > 0) grown = std::min(grown, expected_);
      result = add_block(memory_type, std::max(grown, needs.size), VK_NULL_HANDLE);
    }
    if (own_block || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
      result = add_block(memory_type, needs.size, own_block ? buffer.handle : VK_NULL_HANDLE);
    }
    if (result != VK_SUCCESS) {
      return memory_error(buffer.size, kind, purpose,
                          vulkan_error("vkAllocateMemory", result).message + " (" + std::to_string(bytes_) +
                              " bytes are held already)");
    }
    block = &blocks_.back();
  }

  const VkDeviceSize offset = align_up(block->used, needs.alignment);
  const VkResult result = context_->vk.vkBindBufferMemory(context_->device, buffer.handle, block->memory, offset);
  if (result != VK_SUCCESS) {
    return memory_error(buffer.size, kind, purpose, vulkan_error("vkBindBufferMemory", result).message);
  }
  block->used = offset + needs.size;
  expected_ -= std::min(expected_, needs.size);
  return block->mapped != nullptr ? static_cast<void*>(static_cast<std::byte*>(block->mapped) + offset) : nullptr;
}

VkDeviceSize Arena::held(std::uint32_t type) const {
  VkDeviceSize bytes = 0;
  for (const Block& block : blocks_) bytes += block.type == type ? block.size : 0;
  return bytes;
}

Arena::Block* Arena::find_room(std::uint32_t type, VkDeviceSize size, VkDeviceSize alignment) {
  for (Block& block : blocks_) {
    const VkDeviceSize offset = align_up(block.used, alignment);
    if (block.type == type && !block.dedicated && offset <= block.size && block.size - offset >= size) return &block;
  }
  return nullptr;
}

VkResult Arena::add_block(std::uint32_t type, VkDeviceSize size, VkBuffer dedicated_to) {
  const VkMemoryType& properties = context_->memory.memoryTypes[type];
  // A request for more than the heap is an invalid call, not one that fails.
  if (size > context_->memory.memoryHeaps[properties.heapIndex].size) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  VkMemoryDedicatedAllocateInfo dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  dedicated.buffer = dedicated_to;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = dedicated_to != VK_NULL_HANDLE ? &dedicated : nullptr;
  info.allocationSize = size;
  info.memoryTypeIndex = type;

  Block block;
  block.type = type;
  block.size = size;
  block.dedicated = dedicated_to != VK_NULL_HANDLE;
  make_room(blocks_);
  const VolkDeviceTable& vk = context_->vk;
  VkResult result = vk.vkAllocateMemory(context_->device, &info, context_->allocation_callbacks, &block.memory);
  if (result != VK_SUCCESS) return result;
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if ((properties.propertyFlags & kMappable) == kMappable) {
    result = vk.vkMapMemory(context_->device, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped);
    if (result != VK_SUCCESS) {
      vk.vkFreeMemory(context_->device, block.memory, context_->allocation_callbacks);
      return result;
    }
  }
  blocks_.push_back(block);
  bytes_ += size;
  return VK_SUCCESS;
}

Result<VkBufferView> Arena::create_texel_view(const Buffer& buffer, VkFormat format) {
  const VkDeviceSize largest = context_->limits.maxTexelBufferElements * kTexelBytes;
  if (buffer.size > largest) {
    return Error{ErrorCode::kOutOfMemory, "cannot view " + std::to_string(buffer.size) +
                                              " bytes as texels: the device allows " + std::to_string(largest) +
                                              " (maxTexelBufferElements)"};
  }
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer.handle;
  info.format = format;
  info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  make_room(views_);
  const VkResult result =
      context_->vk.vkCreateBufferView(context_->device, &info, context_->allocation_callbacks, &view);
  if (result != VK_SUCCESS) return vulkan_error("vkCreateBufferView", result);
  views_.push_back(view);
  return view;
}

}  // namespace medial_vk
