// The analyses that Python holds.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "medial_vk/analysis.h"
#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::python {

/// An analysis, and all that its files say of how it was made.
struct AnalysisHandle {
  IndexedMesh mesh;
  AnalysisOptions options;
  DeviceDescription device;
  Analysis result;
};

/// All of it but the mesh as bytes: the same ones for the same analysis.
std::string encode_analysis(const AnalysisHandle& handle);

/// The analysis of `mesh` again. Error: kUsage (bytes of another version of the library, or damaged ones).
Result<std::shared_ptr<AnalysisHandle>> decode_analysis(const IndexedMesh& mesh, std::string_view bytes);

}  // namespace medial_vk::python
