#include "part_fits/kept_extractions.h"

#include <memory>
#include <utility>
#include <vector>

namespace medial_vk {

Extractor kept_extractions(Extractor extractor) {
  using Kept = std::vector<std::pair<ExtractionOptions, Extraction>>;
  return [extractor = std::move(extractor), kept = std::make_shared<Kept>()](
             const IndexedMesh& mesh, const ExtractionOptions& options, const ProgressCallback& progress,
             const std::stop_token& stop) -> Result<Extraction> {
    ExtractionOptions key = options;
    key.threads = 0;  // no result depends on it
    for (const auto& [of, extraction] : *kept) {
      if (of == key) return extraction;
    }
    Result<Extraction> extraction = extractor(mesh, options, progress, stop);
    if (extraction.ok()) kept->emplace_back(key, extraction.value());
    return extraction;
  };
}

}  // namespace medial_vk
