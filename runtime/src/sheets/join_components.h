// The join of components whose common border is mostly no crease.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Rewrites `component_of` (by position, numbers from 0 without gaps, ascending in the order of first voxels) and keeps
/// that order. The weight of a point at the border of two components is the difference of options.border and the
/// turn of its spokes, clamped to 30 degrees of attraction and 4 of repulsion; each point that the border lacks, if it
/// is short for the smaller of the two components, has a repulsion of 4. Joins the two components with the greatest sum
/// (ties are broken by the order of voxels), as long as that is not negative; borders with a third component are then
/// added up. Does nothing if options.crease is 0. docs/theory.md, "Sheets".
void join_components(const VoxelGraph& graph, const SheetOptions& options, std::vector<std::uint32_t>& component_of);

}  // namespace medial_vk
