// Extractions recorded into a host's command buffers: medial spheres of a mesh that moves, in buffers that the host
// draws from or computes with. Recording submits nothing, waits for nothing and reads nothing back.
//
//   auto job = ExtractionJob::create(context, mesh, options);
//   for every frame:
//     mesh.move_vertices(positions);        // if they have moved
//     job.update(mesh);
//     job.record(commands);                 // outside of a render pass
//     ... barriers are recorded: commands that follow, or wait for these, may read job.buffers() ...
//
// The spheres are those of extract_medial_spheres() in mode certified, exact to float: a ball may reach out of the
// solid by its rounding, 2e-6 of the longest side. certify_spheres() (certify.h) tests each in double precision and
// drops those that do not pass.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>

#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// One element of JobBuffers::spheres, 64 bytes, std430. Lengths are in the unit box: see Placement.
struct RecordedSphere {
  float centre[3];
  float radius;
  float spoke_a[3];  ///< Unit vector from the centre to its nearest boundary point.
  float object_angle;
  float spoke_b[3];  ///< Unit vector to the boundary point on the other side of the medial sheet.
  float flux;
  std::uint32_t voxel[3];
  std::uint32_t reserved;
};

/// The content of JobBuffers::counts. The first four words are a VkDrawIndirectCommand: an instance for every sphere.
struct RecordedCounts {
  std::uint32_t vertices;  ///< JobOptions::vertices_per_sphere
  std::uint32_t spheres;
  std::uint32_t first_vertex;    ///< 0
  std::uint32_t first_instance;  ///< 0
  std::uint32_t undecided;       ///< Number of undecided voxels.
  std::uint32_t complete;        ///< 0: the memory budget was too small or lists were too long; no spheres.
};

/// The map from the unit box to the units of the mesh: p -> origin + scale p. Radii are multiplied by `scale`.
struct Placement {
  Point origin = {0, 0, 0};
  double scale = 1;
};

/// Buffers of the job, on its device and for its queue family; they stay the same until the job is destroyed. All have
/// the usages storage, uniform texel, vertex, indirect, transfer source and transfer destination.
struct JobBuffers {
  VkBuffer spheres = VK_NULL_HANDLE;  ///< RecordedSphere, from byte 0 on, in no particular order.
  VkDeviceSize sphere_bytes = 0;      ///< Size of that buffer.
  VkBuffer counts = VK_NULL_HANDLE;   ///< RecordedCounts at byte 0.
};

struct JobOptions {
  /// Number of recorded sequences that may be pending or running at a time. Precondition of update() and record(): the
  /// sequence that was recorded `frames` calls ago has finished.
  std::uint32_t frames = 1;
  std::uint32_t vertices_per_sphere = 4;  ///< The value of RecordedCounts::vertices.
};

/// Move-only. For one thread at a time, like its context, which must outlive it.
class ExtractionJob {
 public:
  /// Allocates memory and compiles programs, so that recording does neither. Submits work and waits for it if the
  /// device has memory of its own. Errors: kUsage (an option out of range, mode thesis, no frames), kInvalidMesh,
  /// kOutOfMemory, kInternal.
  static Result<ExtractionJob> create(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options,
                                      const JobOptions& job = {});
  ExtractionJob(ExtractionJob&&) noexcept;
  ExtractionJob& operator=(ExtractionJob&&) noexcept;
  /// Precondition: every recorded sequence has finished, or is never submitted.
  ~ExtractionJob();

  /// Follows vertices that have moved, from the next record() on: `moved` is the mesh passed to create(), after
  /// move_vertices(). CPU work. Errors: kUsage (another mesh, as for Scene::update(); or the job was updated already
  /// since the last record()), kInvalidMesh (no extent: record() fails until an update succeeds), kOutOfMemory.
  Status update(const IndexedMesh& moved);

  /// Appends an extraction to `commands`. Precondition: `commands` are in the recording state, outside of a render
  /// pass, and belong to the context's queue family or to one that shares its resources. Barriers before and after
  /// order it against everything else in the queue, so any stage of later commands may read `buffers()`. Errors:
  /// kOutOfMemory, kInternal; `commands` are then unusable.
  Status record(VkCommandBuffer commands);

  JobBuffers buffers() const;
  /// The placement of the spheres of the last recorded sequence.
  Placement placement() const;
  /// The counts of the sequence that was recorded `frames` calls of record() ago (of the last one if `frames` is 1).
  /// Precondition: it has finished. If its lists were too long, the next record() allows for longer ones.
  RecordedCounts counts();

 private:
  struct Impl;
  explicit ExtractionJob(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
