// Curvatures at vertices as published: means over Voronoi cells, propagated (Section 5.4.3).
#pragma once

#include <vector>

#include "base/loop_watch.h"
#include "medial_vk/vertex_curvature.h"
#include "vertex_curvature/surface_tips.h"

namespace medial_vk {

/// Throws LoopStopped.
std::vector<VertexCurvature> voronoi_means(const SurfaceTips& tips, const BoundaryCurvature& curvature,
                                           unsigned threads, LoopWatch& watch);

}  // namespace medial_vk
