// The links of Section 2.5, and the pieces that they hold together.
#pragma once

#include <cstdint>
#include <vector>

#include "sheets/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// By place: a number of its piece, ascending from 0 in the order of their first voxels.
std::vector<std::uint32_t> grow_pieces(const VoxelGraph& graph, double object_angle, const SheetParameters& parameters);

}  // namespace medial_vk
