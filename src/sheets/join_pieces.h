// Pieces whose common border is for the most part no crease are one.
#pragma once

#include <cstdint>
#include <vector>

#include "sheets/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Rewrites `piece_of` (by place, numbers from 0 without gaps, ascending in the order of first voxels) and keeps that
/// order. The *turn* of a border is that of the point in its middle, in ascending order of turns; a border that is
/// short for the smaller of its two pieces counts as longer, by points that turn by any angle. Joins the two pieces
/// with the border that turns least, as long as that is no more than parameters.border; nothing if parameters.crease
/// is 0. docs/theory.md, "Sheets".
void join_pieces(const VoxelGraph& graph, const SheetParameters& parameters, std::vector<std::uint32_t>& piece_of);

}  // namespace medial_vk
