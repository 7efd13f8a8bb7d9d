// `--check` of `medial-vk plane`: every arc by brute force over all segments.
#pragma once

#include <functional>

#include "check_reports/check_report.h"
#include "medial_vk/plane_axis.h"

namespace medial_vk {

/// Tests an axis as found by find_plane_axis() with these options, before anything is pruned, against the reference:
/// its nodes and points of its arcs, and samples of the exact axis, which begin at the boundary and know nothing of the
/// arcs. `progress(done)` gets 0 to 1. Time: the product of the numbers of arcs and segments, times some nanoseconds.
CheckReport check_plane_axis(const PreparedShape& shape, const PlaneAxisOptions& options, const PlaneAxis& axis,
                             const std::function<void(double)>& progress);

}  // namespace medial_vk
