#include "reference_bridge/reference_extractor.h"

#include "cpu_reference/extract.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {

Extractor reference_extractor() {
  return [](const IndexedMesh& mesh, const ExtractionOptions& options, const ProgressCallback& progress,
            const std::stop_token& stop) -> Result<Extraction> {
    const auto goes_on = [&](double done) {
      if (progress) progress(done);
      return !stop.stop_requested();
    };
    const reference::Result result = reference::extract(to_reference(mesh.prepared()), to_reference(options), goes_on);
    if (result.interrupted) return Error{ErrorCode::kInterrupted, "interrupted"};
    return from_reference(result);
  };
}

}  // namespace medial_vk
