// The rim of a sheet.
#pragma once

#include <cstdint>

#include "sheets/voxel_graph.h"

namespace medial_vk {

/// True if the directions to neighbours, projected along the normal, leave a gap of a third of a turn or more.
/// Neighbours within 18 degrees of the normal do not count.
bool is_rim(const VoxelGraph& graph, std::uint32_t position);

}  // namespace medial_vk
