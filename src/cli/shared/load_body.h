// A body file as a solid with balls, proved again.
#pragma once

#include <string>
#include <vector>

#include "body_files/body_file.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_proofs.h"

namespace medial_vk::cli {

/// What Body::create() takes.
struct LoadedBody {
  IndexedMesh mesh;
  std::vector<Ball> inside, cover;
};

/// Proves that the balls inside are inside the solid and that the cover covers it; of an open mesh, that there are none
/// inside and that the cover covers its surface. `path` is the name of the body in messages. Errors: kInvalidMesh (a
/// ball that reaches out, a point that is not covered, no balls), kOutOfMemory.
Result<SphereProofs> prove_body(const LoadedBody& body, const std::string& path, unsigned threads);

/// Prepares the mesh anew, without a cut, and proves that the balls inside are inside the solid and that the cover
/// covers it: nothing in the file is believed. `path` is its name in messages. Appends the seconds of "prepare" and
/// "prove" to `times`. Errors: kInvalidMesh (a ball that reaches out, a point that is not covered), kOutOfMemory,
/// kInterrupted.
Result<LoadedBody> load_body(const BodyFile& file, const std::string& path, unsigned threads,
                             std::vector<StageTime>& times);

}  // namespace medial_vk::cli
