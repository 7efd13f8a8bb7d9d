#include "part_fits/resident_meshes.h"

#include <utility>

namespace medial_vk {

Extractor ResidentMeshes::extractor() {
  auto own = std::make_shared<Extractor>();
  extractors_.push_back(own);
  return [this, own = std::move(own)](const IndexedMesh& mesh, const ExtractionOptions& options,
                                      const ProgressCallback& progress,
                                      const std::stop_token& stop) -> Result<Extraction> {
    if (!*own) *own = make_();
    Result<Extraction> found = (*own)(mesh, options, progress, stop);
    const bool lacks_memory = !found.ok() && found.error().code == ErrorCode::kOutOfMemory;
    if (!lacks_memory || !release_all_but(*own)) return found;
    return (*own)(mesh, options, progress, stop);
  };
}

/// True if there were others.
bool ResidentMeshes::release_all_but(const Extractor& kept) {
  bool released = false;
  for (const std::weak_ptr<Extractor>& extractor : extractors_) {
    const std::shared_ptr<Extractor> other = extractor.lock();
    if (!other || other.get() == &kept || !*other) continue;
    *other = nullptr;
    released = true;
  }
  return released;
}

}  // namespace medial_vk
