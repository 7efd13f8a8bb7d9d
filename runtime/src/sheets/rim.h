// Where a sheet ends.
#pragma once

#include <cstdint>

#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Is there a gap of a third of a turn or more between the directions to the points around, seen along the normal?
/// Points above it or below, within 18 degrees of the normal, do not count.
bool is_rim(const VoxelGraph& graph, std::uint32_t place);

}  // namespace medial_vk
