// `--check` of `medial-vk distance`: every interval against all pairs of triangles.
#pragma once

#include <functional>
#include <span>

#include "check_reports/check_report.h"
#include "medial_vk/mesh.h"
#include "medial_vk/proximity.h"

namespace medial_vk {

/// Tests the results of distances() against the reference. `seen(i)` is called before result i. Time: the product of
/// the numbers of triangles, times a few nanoseconds, for each pose.
CheckReport check_distances(const PreparedMesh& a, const PreparedMesh& b, std::span<const Pose> poses,
                            std::span<const Distance> distances, const DistanceOptions& options,
                            const std::function<void(std::size_t)>& seen);

/// Tests the results of distance_bounds() in the same way.
CheckReport check_distance_bounds(const PreparedMesh& a, const PreparedMesh& b, std::span<const Pose> poses,
                                  std::span<const DistanceBounds> bounds, const std::function<void(std::size_t)>& seen);

}  // namespace medial_vk
