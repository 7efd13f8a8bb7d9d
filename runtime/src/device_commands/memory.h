// Device memory: buffers cut from an arena of large allocations.
#pragma once

#include <volk.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "device/internals.h"
#include "medial_vk/result.h"

namespace medial_vk {

enum class MemoryKind {
  kDevice,    // fast for the device; mapped only if the memory happens to be host-visible
  kTexels,    // the same, for a buffer that kernels read as texels only: maxStorageBufferRange does not bound it
  kUpload,    // host-visible, coherent, written by the host
  kReadback,  // host-visible, coherent, cached if such memory exists, read by the host
};

/// A range of a buffer, as a kernel binds it.
struct BufferRange {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize size = VK_WHOLE_SIZE;

  bool operator==(const BufferRange&) const = default;
};

/// A buffer for storage, indirect dispatch, transfer and (if small enough for the device) uniform texels.
struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceSize size = 0;
  void* mapped = nullptr;  // kUpload and kReadback always, kDevice if possible

  BufferRange range() const { return {handle, 0, size}; }
  BufferRange range(VkDeviceSize offset, VkDeviceSize bytes) const { return {handle, offset, bytes}; }
  /// The range bound as storage by kernels that may read the buffer as texels. If they do, it is the start of the
  /// buffer, which is never read.
  BufferRange storage_range(bool read_as_texels) const { return {handle, 0, read_as_texels ? 16 : size}; }
};

/// Bytes of staging memory for the upload of a mesh (uploads.h) and the download of points; 0 where the host can map
/// all memory.
VkDeviceSize bytes_on_the_way(const ContextImpl& context);
/// The part of this budget that is left to the compiler of a driver for processors, which uses the same memory; 0 for
/// GPUs and llvmpipe. SwiftShader takes up to 150 MiB, for a short time.
std::uint64_t bytes_of_compiler(const ContextImpl& context, std::uint64_t budget);
/// The rest of a memory budget beside `held` bytes; at least a quarter of the budget, so that the sum may exceed it.
inline std::uint64_t left_of(std::uint64_t budget, VkDeviceSize held) {
  return std::max(budget - std::min<std::uint64_t>(budget, held), budget / 4);
}

/// Owns buffers and their memory; all are freed together with the arena. Move-only.
class Arena {
 public:
  explicit Arena(ContextImpl& context) : context_(&context) {}
  Arena(Arena&&) noexcept;
  Arena& operator=(Arena&&) noexcept;
  ~Arena();

  /// Errors: kOutOfMemory, naming bytes and purpose. Sizes are rounded up to 16 bytes, at least 16.
  Result<Buffer> create_buffer(VkDeviceSize bytes, MemoryKind kind, const char* purpose);
  /// A view of texels of 16 bytes over a whole buffer, vec4 or uvec4. Errors: kOutOfMemory.
  Result<VkBufferView> create_texel_view(const Buffer& buffer, VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT);
  /// Announces requests of that many bytes in total: until all have been made, no block is larger than the rest of
  /// them.
  void expect(VkDeviceSize bytes) { expected_ = bytes; }
  /// Bytes of device memory held.
  VkDeviceSize bytes() const { return bytes_; }

 private:
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint32_t type = 0;
    VkDeviceSize size = 0;
    VkDeviceSize used = 0;
    void* mapped = nullptr;
    bool dedicated = false;  // belongs to one buffer
  };
  void release();
  Result<void*> bind_memory(const Buffer& buffer, MemoryKind kind, const char* purpose);
  VkDeviceSize held(std::uint32_t type) const;
  Block* find_room(std::uint32_t type, VkDeviceSize size, VkDeviceSize alignment);
  VkResult add_block(std::uint32_t type, VkDeviceSize size, VkBuffer dedicated_to);

  ContextImpl* context_;
  std::vector<Block> blocks_;
  std::vector<VkBuffer> buffers_;
  std::vector<VkBufferView> views_;
  VkDeviceSize bytes_ = 0;
  VkDeviceSize expected_ = 0;
};

}  // namespace medial_vk
