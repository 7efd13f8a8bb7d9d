#include "reference_bridge/reference_extractor.h"

#include "cpu_reference/extract.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {

Extractor reference_extractor(const std::function<void(const TimeEstimate&)>& on_estimate) {
  return [on_estimate](const IndexedMesh& mesh, const ExtractionOptions& options, const ProgressCallback& progress,
                       const std::stop_token& stop) -> Result<Extraction> {
    if (options.mode == Mode::kThesis && mesh.side() == MeshSide::kOutside) {
      return Error{ErrorCode::kUsage, "`mode` thesis searches the inside only"};
    }
    const auto goes_on = [&](double done) {
      if (progress) progress(done);
      return !stop.stop_requested();
    };
    std::function<void(const reference::TimeEstimate&)> pass_on;
    if (on_estimate) {
      pass_on = [&](const reference::TimeEstimate& e) { on_estimate({e.seconds, e.voxels, e.is_cut_off}); };
    }
    const reference::Result result = reference::extract(to_reference(mesh), to_reference(options), goes_on, pass_on);
    if (result.interrupted) return Error{ErrorCode::kInterrupted, "interrupted"};
    Extraction extraction = from_reference(result);
    extraction.side = mesh.side();
    return extraction;
  };
}

}  // namespace medial_vk
