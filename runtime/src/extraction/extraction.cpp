// Extraction in either mode, of a mesh that is uploaded first or is on the device already.
#include "medial_vk/extraction.h"

#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "extraction/certified/certified_extraction.h"
#include "extraction/common/check_options.h"
#include "extraction/thesis/thesis_extraction.h"
#include "queries/scene_impl.h"

namespace medial_vk {
namespace {

/// `extract` receives checked options and a watch.
template <class Extract>
Result<Extraction> watched(const ExtractionOptions& options, const ProgressCallback& progress,
                           const std::stop_token& stop, const Extract& extract) {
  if (Status s = check_options(options); !s.ok()) return s.error();
  StopWatch watch(progress, stop);
  Result<Extraction> extraction = catch_out_of_memory("extracting medial spheres", [&] { return extract(watch); });
  if (extraction.ok() && progress) progress(1.0);
  return extraction;
}

Result<Extraction> extract(ContextImpl& context, DeviceMesh& mesh, const ExtractionOptions& options, StopWatch& watch) {
  if (watch.stopped()) return StopWatch::error();
  if (options.mode == Mode::kThesis && mesh.side == MeshSide::kOutside)
    return Error{ErrorCode::kUsage, "`mode` thesis searches the inside only"};
  if (options.mode == Mode::kThesis) return extract_thesis(context, mesh, options, watch);
  if (Status s = mesh.add_links(); !s.ok()) return s.error();
  return extract_certified(context, mesh, options, watch);
}

/// A mesh that stays on the device from one extraction to the next.
struct KeptMesh {
  std::optional<IndexedMesh> source;
  std::unique_ptr<DeviceMesh> mesh;

  Status keep(ContextImpl& context, const IndexedMesh& wanted, bool with_links) {
    if (mesh && mesh->intact && source->is_same(wanted)) return {};
    mesh.reset();  // its memory is needed
    Result<DeviceMesh> uploaded = DeviceMesh::create(context, wanted, with_links);
    if (!uploaded.ok()) return uploaded.error();
    mesh = std::make_unique<DeviceMesh>(std::move(uploaded).value());
    source.emplace(wanted);
    return {};
  }
};

}  // namespace

Result<Extraction> extract_medial_spheres(const IndexedMesh& mesh, const ExtractionOptions& options, Context& context,
                                          const ProgressCallback& progress, const std::stop_token& stop) {
  return watched(options, progress, stop, [&](StopWatch& watch) -> Result<Extraction> {
    ContextImpl& device = Internals::of(context);
    const ThreadsOfCall threads(device, options.threads);
    Result<DeviceMesh> uploaded = DeviceMesh::create(device, mesh, options.mode == Mode::kCertified);
    if (!uploaded.ok()) return uploaded.error();
    return extract(device, uploaded.value(), options, watch);
  });
}

Result<Extraction> extract_medial_spheres(Scene& scene, const ExtractionOptions& options,
                                          const ProgressCallback& progress, const std::stop_token& stop) {
  return watched(options, progress, stop, [&](StopWatch& watch) -> Result<Extraction> {
    auto& of = Internals::of(scene);
    if (Status ready = of.usable(); !ready.ok()) return ready.error();
    const ThreadsOfCall threads(*of.context, options.threads);
    return extract(*of.context, of.mesh, options, watch);
  });
}

Extractor device_extractor(Context& context) try {
  return
      [&context, kept = std::make_shared<KeptMesh>()](const IndexedMesh& mesh, const ExtractionOptions& options,
                                                      const ProgressCallback& progress, const std::stop_token& stop) {
        return watched(options, progress, stop, [&](StopWatch& watch) -> Result<Extraction> {
          ContextImpl& device = Internals::of(context);
          const ThreadsOfCall threads(device, options.threads);
          const bool with_links = options.mode == Mode::kCertified;
          if (Status status = kept->keep(device, mesh, with_links); !status.ok()) return status.error();
          return extract(device, *kept->mesh, options, watch);
        });
      };
} catch (const std::bad_alloc&) {
  // A function without captures takes no memory of its own.
  return [](const IndexedMesh&, const ExtractionOptions&, const ProgressCallback&,
            const std::stop_token&) -> Result<Extraction> { return out_of_memory("making an extractor"); };
}

}  // namespace medial_vk
