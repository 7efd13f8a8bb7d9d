// Which extraction is asked for.
#include "medial_vk/extraction.h"

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "extraction/certified/certified_extraction.h"
#include "extraction/common/check_parameters.h"
#include "extraction/thesis/thesis_extraction.h"

namespace medial_vk {
namespace {

/// Without an index one is made, where it is needed.
Result<Extraction> extract(Context& context, const MeshView& mesh, const MeshIndex* index,
                           const ExtractionParameters& parameters, const ProgressCallback& progress,
                           const std::stop_token& stop) {
  if (Status s = check_parameters(parameters); !s.ok()) return s.error();
  StopWatch watch(progress, stop);
  Result<Extraction> extraction = catch_out_of_memory("extracting medial spheres", [&]() -> Result<Extraction> {
    if (parameters.mode == Mode::kThesis) return extract_thesis(context.impl(), mesh, parameters, watch);
    if (index != nullptr) return extract_certified(context.impl(), mesh, *index, parameters, watch);
    const VkPhysicalDeviceLimits& limits = context.impl().limits;
    if (Status s = DeviceMesh::check_size(mesh.triangles.size(), limits); !s.ok()) return s.error();
    const Result<MeshIndex> made = MeshIndex::create(mesh);
    if (!made.ok()) return made.error();
    if (watch.stopped()) return StopWatch::error();
    return extract_certified(context.impl(), mesh, made.value(), parameters, watch);
  });
  if (extraction.ok() && progress) progress(1.0);
  return extraction;
}

}  // namespace

Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress,
                                          const std::stop_token& stop) {
  return extract(context, mesh, nullptr, parameters, progress, stop);
}

Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh, const MeshIndex& index,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress,
                                          const std::stop_token& stop) {
  return extract(context, mesh, &index, parameters, progress, stop);
}

}  // namespace medial_vk
