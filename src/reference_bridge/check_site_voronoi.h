// `--check` of `medial-vk voronoi`: every point, and samples of the surface, by the reference's closest points.
#pragma once

#include <functional>
#include <span>

#include "check_reports/check_report.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk {

/// Tests that each point is equally far from its sites and no other site is nearer, and that the voxels of samples,
/// found by bisection of chords of the box, have a point, or are among those that have none for a stated reason.
/// Samples whose contacts are the same do not count. `progress` gets the finished share.
CheckReport check_site_voronoi(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi,
                               const std::function<void(double)>& progress);

}  // namespace medial_vk
