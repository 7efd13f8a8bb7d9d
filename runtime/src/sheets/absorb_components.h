// Absorption of components that are too small for sheets of their own by their neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

struct Absorbed {
  std::uint64_t components = 0;  ///< Number of components that have disappeared.
  std::uint64_t points = 0;      ///< Number of points whose component has changed.
  /// By position: 1 if its component is too small for a sheet, even after the union with others, else 0. This does not
  /// depend on neighbours, except that a component with neither borders nor rims is not small.
  std::vector<std::uint8_t> is_small;
};

/// Rewrites `component_of` (by position, numbers from 0 without gaps). Components that have a neighbour and are
/// narrower than options.width allows, or have fewer points than options.absorb_fragments, are all absorbed at once:
/// voxel by voxel from their borders inwards, each point by the component that has most of the voxels around it. Small
/// components that are connected and touch no other are united, and their union may be large enough. The numbers are
/// those of former components, with gaps. `voxel_size` is the side of the graph's voxels, the resolution of widths.
Absorbed absorb_components(const VoxelGraph& graph, double voxel_size, const SheetOptions& options,
                           std::vector<std::uint32_t>& component_of);

}  // namespace medial_vk
