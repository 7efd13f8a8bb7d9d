#pragma once

#include <vector>

#include "cli/options/voronoi/voronoi_options.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"
#include "medial_vk/site_voronoi.h"
#include "output/site_files/site_record.h"

namespace medial_vk::cli {

/// Reads and prepares all meshes, in their order; then points, segments and triangles. Fills the sites and assumptions
/// of the record. Errors: kInvalidMesh with the file, kOutOfMemory.
Result<std::vector<VoronoiSite>> load_sites(const VoronoiCommandOptions& options, SiteRecord& record,
                                            std::vector<StageTime>& times);

}  // namespace medial_vk::cli
