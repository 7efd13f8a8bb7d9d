// Pieces that are too small for sheets of their own join a neighbour.
#pragma once

#include <cstdint>
#include <vector>

#include "sheets/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

struct Absorbed {
  std::uint64_t pieces = 0;
  std::uint64_t points = 0;
};

/// Rewrites `piece_of` (by place, numbers from 0 without gaps) so that no piece is left that has a neighbour and is
/// narrower than parameters.width or has fewer points than parameters.absorb_fragments. The one that is narrowest
/// against its balls goes first, each to the neighbour that it touches in most pairs of voxels. Numbers are those of
/// pieces that there were, with gaps.
Absorbed absorb_pieces(const VoxelGraph& graph, double voxel_size, const SheetParameters& parameters,
                       std::vector<std::uint32_t>& piece_of);

}  // namespace medial_vk
