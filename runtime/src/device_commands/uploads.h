// Uploads of bytes of the host into buffers of the device.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "device/internals.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Copies through two blocks of staging memory, of which the host fills one while the device empties the other, on a
/// queue of its own if it has one; nothing is staged if the buffer is mapped. The host does not wait: kernels may read
/// the data once finish() has returned.
class Uploads {
 public:
  explicit Uploads(ContextImpl& context);
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;
  /// Waits for pending copies; the rest is dropped.
  ~Uploads();

  /// To the start of the buffer, which outlives this object or finish(); `bytes` may be released when this returns. The
  /// device must not use the buffer until finish(). Errors: kOutOfMemory, kInternal (too many bytes, device lost).
  Status add(const Buffer& buffer, std::span<const std::byte> bytes);
  /// Submits all copies. Errors: kOutOfMemory, kInternal (device lost).
  Status flush();
  /// Waits until all copies have finished. Errors: kOutOfMemory, kInternal (device lost).
  Status finish();

 private:
  struct Block {
    Block(ContextImpl& context, Commands::Queue queue) : commands(context, queue) {}
    Buffer memory;
    VkDeviceSize used = 0;
    bool records = false;
    Commands commands;
  };
  Status begin(Block& block);
  Status send(Block& block, const Semaphore* signal);

  ContextImpl* context_;
  Arena arena_;
  Semaphore sent_;
  Commands received_;  // on the queue of the kernels
  std::array<Block, 2> blocks_;
  std::size_t current_ = 0;
  bool is_sending_ = false;
};

/// Uploads one buffer. Blocks.
Status upload(ContextImpl& context, const Buffer& buffer, std::span<const std::byte> bytes);

/// A new buffer that will have these values.
template <class T>
Result<Buffer> create_filled(Arena& arena, Uploads& uploads, std::span<const T> values, const char* purpose) {
  Result<Buffer> buffer = arena.create_buffer(values.size_bytes(), MemoryKind::kDevice, purpose);
  if (!buffer.ok()) return buffer;
  if (Status status = uploads.add(buffer.value(), std::as_bytes(values)); !status.ok()) return status.error();
  return buffer;
}

}  // namespace medial_vk
