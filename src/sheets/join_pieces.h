// Pieces whose common border is for the most part no crease are one.
#pragma once

#include <cstdint>
#include <vector>

#include "sheets/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Rewrites `piece_of` (by place, numbers from 0 without gaps, ascending in the order of first voxels) and keeps that
/// order. Joins the two pieces with the largest share of pairs of voxels across their border that are linked by
/// parameters.crease + kBorderTurn, as long as it is a half or more.
void join_pieces(const VoxelGraph& graph, double object_angle, const SheetParameters& parameters,
                 std::vector<std::uint32_t>& piece_of);

}  // namespace medial_vk
