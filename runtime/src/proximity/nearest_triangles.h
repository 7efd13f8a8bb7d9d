// The distance between the triangles of two trees: docs/theory.md, "Distances".
#pragma once

#include <stop_token>

#include "medial_vk/proximity.h"
#include "proximity/placement.h"
#include "proximity/surface_tree.h"

namespace medial_vk {

/// An interval around the distance of the triangles, which is no wider than `options.tolerance` and a few errors where
/// the distance is below `options.limit`, beyond which only that is proved. `upper` is 0 only if two triangles cross. A
/// search that starts with two triangles of `start` has a bound from the beginning. Allocates nothing. Throws
/// LoopStopped after a request to `stop`.
Distance nearest_triangles(const SurfaceTree& a, const SurfaceTree& b, const Placement& placement,
                           const Distance& start, const DistanceOptions& options, const std::stop_token& stop);

}  // namespace medial_vk
