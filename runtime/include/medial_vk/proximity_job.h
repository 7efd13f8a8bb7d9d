// Bounds of distances, or verdicts on collisions, in many poses, recorded into a host's command buffers. Recording
// submits nothing, waits for nothing and reads nothing back.
//
//   auto job = ProximityJob::create(device_bodies, {.poses = 100'000, .answers = ProximityAnswers::kCollisions});
//   for every step:
//     ... kernels of the host write job.buffers().poses, or: job.set_poses(pairs); ...
//     job.record(commands, 100'000);        // outside of a render pass
//     ... barriers are recorded: commands that follow, or wait for these, may read job.buffers().answers ...
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/device_bodies.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// An element of ProximityBuffers::poses, 64 bytes, std430: a pose that takes the frame of body `b` to the frame of
/// body `a`, in the units of the bodies.
struct RecordedPose {
  float row_x[4];  ///< The first row of the rotation, and the first coordinate of the shift.
  float row_y[4];
  float row_z[4];
  std::uint32_t a;  ///< Indices of the bodies that were passed to DeviceBodies::create().
  std::uint32_t b;
  float reserved[2];  ///< Not read.
};

/// An element of ProximityBuffers::answers for ProximityAnswers::kBounds, 24 bytes: DistanceBounds in float.
struct RecordedBounds {
  float lower;
  float upper;
  BallPair cover_pair, inside_pair;
};

enum class ProximityAnswers {
  kCollisions,  ///< One word for each pose, a Collision: 0 free, 1 hit, 2 undecided.
  kBounds,      ///< One RecordedBounds for each pose.
};

struct ProximityJobOptions {
  std::uint32_t poses = 65'536;  ///< The greatest number of poses of a recorded sequence.
  ProximityAnswers answers = ProximityAnswers::kCollisions;
  /// Number of recorded sequences that may be pending or running at a time. Precondition of set_poses() and record():
  /// the sequence that was recorded `frames` calls ago has finished.
  std::uint32_t frames = 1;
};

/// Buffers of the job, on its device and for its queue family; they stay the same until the job is destroyed. Both have
/// the usages storage, vertex, indirect, transfer source and transfer destination. At first they contain anything.
struct ProximityBuffers {
  VkBuffer poses = VK_NULL_HANDLE;    ///< RecordedPose, from byte 0 on; a host may write them.
  VkBuffer answers = VK_NULL_HANDLE;  ///< In the order of the poses.
};

/// Answers for poses of set_poses() have the accuracy of DeviceBodies; a pose out of the range of float is undecided.
/// For a RecordedPose the proof is about the rigid motion whose rotation is nearest to its rows. Let L be the length of
/// the shift plus the distances of both bodies from the origins of their frames. For rows of a rotation that were
/// rounded to float, bounds are then within 1.3e-5 (M + L) + 1e-17 of the distances of the sets, and overlaps and gaps
/// beyond that are decided. A search that is too long for the device's loops gives the verdict undecided, or the lower
/// bound 0 with the upper bound so far.
///
/// Move-only. For one thread at a time, like the context of its bodies. The context is one that shares the host's
/// device (host_device.h). It and the bodies must outlive the job.
class ProximityJob {
 public:
  /// Allocates memory of the device and compiles the program, so that recording does neither. Errors: kUsage (no poses,
  /// no frames), kOutOfMemory, kInternal.
  static Result<ProximityJob> create(DeviceBodies& bodies, const ProximityJobOptions& options = {});
  ProximityJob(ProximityJob&&) noexcept;
  ProximityJob& operator=(ProximityJob&&) noexcept;
  /// Precondition: every recorded sequence has finished, or is never submitted.
  ~ProximityJob();

  /// The next recorded sequence begins with a copy of these to the first elements of buffers().poses. Errors: kUsage
  /// (more than `poses` of the options; an index that is too large).
  Status set_poses(std::span<const PosedPair> pairs, const BatchOptions& options = {});

  /// Appends the answers for the first `count` poses of the buffer to `commands`. Precondition: `commands` are in the
  /// recording state, outside of a render pass, and belong to the context's queue family or to one that shares its
  /// resources. Barriers before and after order it against everything else in the queue. A RecordedPose is answered
  /// with undecided, or with 0 and infinity, if an index is too large (below 2^31), if it is out of the range of float,
  /// or if R R^T - I has a Frobenius norm of 1e-3 or more, where R are its rows. Errors: kUsage (more than `poses` of
  /// the options); kOutOfMemory, kInternal: `commands` are then unusable.
  Status record(VkCommandBuffer commands, std::uint32_t count);

  ProximityBuffers buffers() const;

 private:
  struct Impl;
  explicit ProximityJob(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
