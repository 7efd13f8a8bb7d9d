// Pieces that are too small for sheets of their own go to those around.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

struct Absorbed {
  std::uint64_t pieces = 0;  ///< By how many there are fewer.
  std::uint64_t points = 0;  ///< Whose piece is another now.
  /// By place: 1 if its piece is too small for a sheet, and so is what it has become one with, else 0. That does not
  /// ask for neighbours, but a piece with neither borders nor rims is large.
  std::vector<std::uint8_t> is_small;
};

/// Rewrites `piece_of` (by place, numbers from 0 without gaps): pieces that have a neighbour and are narrower than
/// parameters.width allows or have fewer points than parameters.absorb_fragments, all at once, go to the pieces around,
/// voxel by voxel from their borders inwards, each point to the piece that has most of the voxels around it. Small
/// pieces that hang together and touch no other become one, which may be large enough. Numbers are those of pieces that
/// there were, with gaps. `voxel_size` is the side of the graph's voxels: what is no wider cannot be told from what is.
Absorbed absorb_pieces(const VoxelGraph& graph, double voxel_size, const SheetOptions& parameters,
                       std::vector<std::uint32_t>& piece_of);

}  // namespace medial_vk
