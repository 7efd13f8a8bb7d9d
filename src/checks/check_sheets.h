// `--check`: what the sheets promise, tested again from the written numbers.
#pragma once

#include <span>
#include <vector>

#include "checks/check_report.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

/// Every sheet is connected by voxels that touch, and numbers are 0, 1, ... by decreasing number of points; with gaps
/// unless `all_kept`. One line for each; by another way than find_sheets() takes.
std::vector<CheckLine> check_sheets(std::span<const MedialSphere> spheres, bool all_kept = true);

}  // namespace medial_vk
