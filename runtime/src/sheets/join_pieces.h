// Pieces whose common border is for the most part no crease are one.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Rewrites `piece_of` (by place, numbers from 0 without gaps, ascending in the order of first voxels) and keeps that
/// order. Each point at the border of two pieces pulls them together by as much as its spokes turn by less than
/// parameters.border (30 degrees at most), or apart by as much as they turn by more (4 at most); so do points that a
/// border lacks that is short for the smaller of its two pieces, by 4. Joins the two pieces with the greatest sum (of
/// equals, one by the order of voxels), as long as that is not negative; borders with a third add up. Nothing if
/// parameters.crease is 0. docs/theory.md, "Sheets".
void join_pieces(const VoxelGraph& graph, const SheetOptions& parameters, std::vector<std::uint32_t>& piece_of);

}  // namespace medial_vk
