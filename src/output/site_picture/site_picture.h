#pragma once

#include <span>

#include "medial_vk/site_voronoi.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"
#include "output/site_files/site_record.h"

namespace medial_vk {

/// The sites as glass, and the faces between them as a surface in a colour for each pair, with a disc for each point
/// that has no face; thin prisms for segments and points, and dots for the path. Drawn on the CPU, on one thread.
Picture draw_sites(const SiteRecord& record, std::span<const VoronoiSite> sites, const PictureOptions& options);

}  // namespace medial_vk
