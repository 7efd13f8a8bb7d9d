// The whole of the main job behind one call: find medial spheres on a device or with the CPU reference, then certify
// them in double precision. The command line and every later product use this.
#pragma once

#include <vector>

#include "base/stage_progress.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/mesh.h"
#include "medial_vk/mesh_index.h"

namespace medial_vk {

enum class Backend {
  kVulkan,  ///< The device of a Context.
  kCpu,     ///< The CPU reference: double precision, one thread, no Vulkan at all.
};

struct CertifiedExtraction {
  Extraction extraction;
  CertifyReport certify;
  std::vector<StageTime> host_times;  ///< Seconds by the clock on the wall: "extract", "certify".
};

/// Length of the longest side of the bounding box, the unit of every fraction in ExtractionParameters.
double longest_side(const MeshReport& report);

/// Finds and certifies the medial spheres of `mesh`. `context` is needed by Backend::kVulkan only; `threads` (0: all)
/// bounds the host's part of it. Does not throw.
/// Errors: those of extract_medial_spheres(); kNoDevice without a context; kOutOfMemory; kInterrupted.
Result<CertifiedExtraction> extract_and_certify(const PreparedMesh& mesh, const ExtractionParameters& parameters,
                                                Backend backend, Context* context, unsigned threads = 0,
                                                const StageProgress& progress = {});

/// Is an index of the mesh any use for that?
bool uses_index(const ExtractionParameters& parameters, Backend backend);

/// The same with an index of `mesh.view()` that is there already.
Result<CertifiedExtraction> extract_and_certify(const PreparedMesh& mesh, const MeshIndex& index,
                                                const ExtractionParameters& parameters, Backend backend,
                                                Context* context, unsigned threads = 0,
                                                const StageProgress& progress = {});

}  // namespace medial_vk
