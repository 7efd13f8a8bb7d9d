// Bodies in the memory of a device, and the kernel that answers queries about them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/internals.h"
#include "device/context_impl.h"
#include "device_commands/memory.h"
#include "device_commands/recorder.h"
#include "medial_vk/device_bodies.h"
#include "proximity_types.h"

namespace medial_vk {

class PoseBatches;

/// What the kernel writes for a pose: a verdict, or bounds.
struct AnswersOfKernel {
  bool are_verdicts = true;
  /// Poses for which its steps do not suffice get the verdict kProximityGivenUp, or the lower bound -1.
  bool leave_rest = false;

  VkDeviceSize bytes() const { return are_verdicts ? sizeof(std::uint32_t) : sizeof(gpu::ProximityBounds); }
};

struct DeviceBodies::Impl {
  explicit Impl(ContextImpl& of, std::span<const Body> on_host);
  ~Impl();

  ContextImpl& context;
  std::vector<Body> bodies;
  Arena arena;
  Buffer nodes, trees;
  std::unique_ptr<PoseBatches> batches;  // made at the first query of the host

  Status upload_balls();
  /// The answers for the first `count` poses, without a barrier.
  void record(Recorder& r, const Buffer& poses, const Buffer& answers, std::uint32_t count,
              const AnswersOfKernel& kind) const;
  /// Error: kUsage (an index that is too large).
  Status check(std::span<const PosedPair> pairs) const;
  PoseBatches& pose_batches();
};

using DeviceBodiesImpl = Internals::ImplOf<DeviceBodies>::Type;

}  // namespace medial_vk
