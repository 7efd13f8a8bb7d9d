// Balls that follow a mesh that moves on the device, recorded into a host's command buffers: what Follower does by the
// tangent rule, in float. Recording submits nothing, waits for nothing and reads nothing back.
//
//   auto job = FollowerJob::create(context, mesh, balls);
//   for every frame:
//     ... kernels of the host write job.buffers().vertices, or: job.set_vertices(positions); ...
//     job.record(commands);                 // outside of a render pass
//     ... barriers are recorded: commands that follow, or wait for these, may read job.buffers().balls ...
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// An element of FollowerBuffers::vertices, 12 bytes, in the units of the mesh.
struct RecordedVertex {
  float position[3];
};

/// An element of FollowerBuffers::balls, 16 bytes, std430, in the units of the mesh.
struct RecordedBall {
  float centre[3];
  float radius;  ///< 0: lost in this frame.
};

struct FollowerJobOptions {
  double shrunk = 0.5;        ///< As FollowerOptions::shrunk.
  double object_angle = 0.5;  ///< As FollowerOptions::object_angle.
  /// Number of recorded sequences that may be pending or running at a time. Precondition of set_vertices() and
  /// record(): the sequence that was recorded `frames` calls ago has finished.
  std::uint32_t frames = 1;
  unsigned threads = 0;  ///< Of the host, for create(); 0: one per core. The result does not depend on it.
};

/// Buffers of the job, on its device and for its queue family; they stay the same until the job is destroyed. All have
/// the usages storage, vertex, indirect, transfer source and transfer destination. At first they contain anything.
struct FollowerBuffers {
  VkBuffer vertices = VK_NULL_HANDLE;  ///< RecordedVertex, in the order of IndexedMesh::view(); a host may write them.
  VkBuffer balls = VK_NULL_HANDLE;     ///< RecordedBall, in the order in which they were given.
  VkBuffer states = VK_NULL_HANDLE;    ///< A word for each of them, a FollowState.
};

/// A ball whose radius is not 0 is open and lies inside the frame of the float vertices, in exact arithmetic: in that
/// set of points which have a positive winding number. For the same contacts and directions radii are less than
/// those of a Follower without steps by up to 1e-5 (L + M), where L is the longest side of the frame and M its greatest
/// coordinate; balls below that are lost. At an edge or a vertex one triangle carries directions here, all of them
/// there. Vulkan leaves the rounding to the driver, so that balls may differ between devices, but all are inside.
///
/// Triangles without an area and triangles that cross are permitted. All balls are lost, and the next frame follows the
/// one before, in a frame with a coordinate that is not finite, with a longest side that is 4,096 times longer or
/// shorter than in the rest pose, or with a coordinate a million times its longest side. In a mirrored frame all are
/// lost, too; they return with the next one.
///
/// Move-only. For one thread at a time, like its context, which must outlive it. The context is one that shares the
/// host's device (host_device.h).
class FollowerJob {
 public:
  /// Allocates memory of the device and compiles the programs, so that recording does neither; uploads, and waits for
  /// the device. The balls lie inside the rest pose, as for Follower::create(). Errors: those of that call; kUsage (no
  /// frames), kInvalidMesh (a mesh that is not closed, that is inside out, or whose longest side is not from 1e-25 to
  /// 1e25), kOutOfMemory, kInternal.
  static Result<FollowerJob> create(Context& context, const IndexedMesh& rest, std::span<const Ball> balls,
                                    const FollowerJobOptions& options = {});
  FollowerJob(FollowerJob&&) noexcept;
  FollowerJob& operator=(FollowerJob&&) noexcept;
  /// Precondition: every recorded sequence has finished, or is never submitted.
  ~FollowerJob();

  /// The next recorded sequence begins with a copy of these, rounded to float, to buffers().vertices. Errors:
  /// kInvalidMesh (another number of vertices, a coordinate that is not finite in float); nothing has changed then.
  Status set_vertices(std::span<const Point> vertices);
  /// The next recorded sequence follows the rest pose, as if no frame had been before it.
  void reset();

  /// Appends the update of all balls to the vertices in the buffer to `commands`. Each sequence that runs follows the
  /// one that ran before it. Precondition: `commands` are in the recording state, outside of a render pass, and belong
  /// to the context's queue family or to one that shares its resources. Barriers before and after order it against
  /// everything else in the queue. Errors: kOutOfMemory, kInternal: `commands` are then unusable.
  Status record(VkCommandBuffer commands);

  FollowerBuffers buffers() const;

 private:
  struct Impl;
  explicit FollowerJob(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
