// The download of the results of a chunk of the certified extraction.
#pragma once

#include <cstdint>
#include <span>

#include "device/internals.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "gpu_types.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// While the points of one chunk are copied and read by the host, the next chunk may be computed, except for its last
/// part, which writes its own points and waits for before_next(). On a CPU nothing is copied: is_shared() is true, and
/// the host reads the points before the next chunk begins.
class ResultDownload {
 public:
  explicit ResultDownload(ContextImpl& context);
  ResultDownload(const ResultDownload&) = delete;
  ResultDownload& operator=(const ResultDownload&) = delete;
  ~ResultDownload();

  bool is_shared() const { return is_shared_; }
  /// Precondition: a chunk has run. Copies the given numbers of its points and undecided voxels. The buffers outlive
  /// finish(). Errors: kOutOfMemory, kInternal (device lost).
  Status start(const Buffer& points, std::uint32_t point_count, const Buffer& undecided, std::uint32_t undecided_count);
  /// The signal that the next chunk waits for before it writes its own points; null: none is pending.
  const Semaphore* before_next();
  /// Waits for the copies. False: there was no start() since the last call. Errors: as start().
  Result<bool> finish();

  /// Valid from finish() until the next start(); in no particular order.
  std::span<const gpu::FoundPoint> points() const { return points_; }
  std::span<const gpu::UndecidedCell> undecided() const { return undecided_; }

 private:
  Status make_room(VkDeviceSize bytes);
  Status hand_over();
  Status record_copies(const Buffer& points, const Buffer& undecided, VkDeviceSize undecided_at);

  ContextImpl* context_;
  bool is_shared_, has_own_queue_;
  bool is_under_way_ = false, is_waited_for_ = true;
  Arena arena_;
  Buffer memory_;
  Semaphore computed_, copied_;
  Commands computed_signal_, copies_;
  std::span<const gpu::FoundPoint> points_;
  std::span<const gpu::UndecidedCell> undecided_;
};

}  // namespace medial_vk
