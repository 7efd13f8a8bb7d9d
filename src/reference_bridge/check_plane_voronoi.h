// `--check` of `medial-vk voronoi` in the plane: every curve by brute force over all segments.
#pragma once

#include <functional>

#include "check_reports/check_report.h"
#include "medial_vk/plane_roadmap.h"

namespace medial_vk {

/// Tests curves as found by find_plane_voronoi() between sites of segments against the reference: nodes and points of
/// arcs, and samples of the exact curves, which begin at places nearest to different sites and know nothing of the
/// arcs; with a roadmap also the widths of its links. `path`: of the roadmap, or null. `progress(done)` gets 0 to 1.
/// Time: the product of the numbers of arcs and segments, times some nanoseconds.
CheckReport check_plane_voronoi(const PlaneSites& sites, const PlaneAxis& curves, const PlaneRoadmap* roadmap,
                                const PlanePath* path, const std::function<void(double)>& progress);

}  // namespace medial_vk
