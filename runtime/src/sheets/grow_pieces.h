// The links of Section 2.5, and the pieces that they hold together.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Are neighbours of one sheet? Two spokes that differ by 2 theta or more are those of a salient sheet, which may pass
/// between the two points: then it does not help that their normals agree (docs/theory.md, "Sheets").
class LinkTest {
 public:
  LinkTest(double object_angle, const SheetOptions& parameters);
  bool operator()(const MedialSphere& p, const MedialSphere& q) const;

 private:
  double normals_, crease_, salient_;  // cosines
};

/// By place: a number of its piece, ascending from 0 in the order of their first voxels.
std::vector<std::uint32_t> grow_pieces(const VoxelGraph& graph, double object_angle, const SheetOptions& parameters);

}  // namespace medial_vk
