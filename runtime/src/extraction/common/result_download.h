// What a chunk of the certified extraction has found, on its way to the host.
#pragma once

#include <cstdint>
#include <span>

#include "commands/commands.h"
#include "commands/memory.h"
#include "gpu_types.h"
#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// While points of one chunk are copied, and looked at by the host, the next chunk may be computed: all but its end,
/// which writes points of its own and waits for before_next(). On a CPU nothing is copied: is_shared(), and the host
/// takes the points before the next chunk begins.
class ResultDownload {
 public:
  explicit ResultDownload(Context::Impl& context);
  ResultDownload(const ResultDownload&) = delete;
  ResultDownload& operator=(const ResultDownload&) = delete;
  ~ResultDownload();

  bool is_shared() const { return is_shared_; }
  /// After a chunk has run: the first so many of its points and undecided voxels. The buffers outlive finish(). Errors:
  /// kOutOfMemory, kInternal (device lost).
  Status start(const Buffer& points, std::uint32_t point_count, const Buffer& undecided, std::uint32_t undecided_count);
  /// What the next chunk waits for before it writes points of its own; null: nothing, or something has waited already.
  const Semaphore* before_next();
  /// Waits for the copies. False: there was no start() since. Errors: as start().
  Result<bool> finish();

  /// After finish(), until the next start(): in no particular order.
  std::span<const gpu::FoundPoint> points() const { return points_; }
  std::span<const gpu::UndecidedCell> undecided() const { return undecided_; }

 private:
  Status make_room(VkDeviceSize bytes);
  Status hand_over();
  Status record_copies(const Buffer& points, const Buffer& undecided, VkDeviceSize undecided_at);

  Context::Impl* context_;
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
