// A recorded job and the mesh that it follows.
#pragma once

#include "medial_vk/extraction_job.h"

namespace medial_vk::test {

/// Moves the mesh of a job, and the job after it. Errors: those of both.
inline Status move(ExtractionJob& job, IndexedMesh& mesh, const MeshView& to) {
  if (Status status = mesh.move_vertices(to.vertices, {.flags = to.flags}); !status.ok()) return status;
  return job.update(mesh);
}

/// ExtractionJob::create() of a mesh that is indexed for it.
inline Result<ExtractionJob> make_job(Context& context, const MeshView& mesh, const ExtractionOptions& options,
                                      const JobOptions& job = {}) {
  Result<IndexedMesh> made = IndexedMesh::build(mesh);
  if (!made.ok()) return made.error();
  return ExtractionJob::create(context, made.value(), options, job);
}

}  // namespace medial_vk::test
