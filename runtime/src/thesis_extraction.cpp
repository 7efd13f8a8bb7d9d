#include "thesis_extraction.h"

namespace medial_vk {

Result<Extraction> extract_thesis(Context::Impl&, const MeshView&, const ExtractionParameters&,
                                  const ProgressCallback&) {
  return Error{ErrorCode::kUsage, "the mode \"thesis\" is not there yet"};
}

}  // namespace medial_vk
