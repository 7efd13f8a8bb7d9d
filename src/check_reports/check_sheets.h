// `--check`: the guarantees for sheets, tested again on the written numbers.
#pragma once

#include <span>
#include <vector>

#include "check_reports/check_report.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Tests that every sheet is connected by voxels that touch, and that sheets are numbered 0, 1, ... by decreasing
/// number of points (with gaps unless `all_kept`). The report has one line per condition. The method differs from that
/// of find_sheets().
std::vector<CheckLine> check_sheets(std::span<const MedialSphere> spheres, bool all_kept = true);

}  // namespace medial_vk
