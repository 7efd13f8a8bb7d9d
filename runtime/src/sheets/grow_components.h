// The links of Section 2.5, and the components that they connect.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/sheets.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// The test whether two neighbours are linked. If spokes of the two points differ by 2 theta or more, a salient sheet
/// may pass between the points, and the agreement of their normals proves nothing (docs/theory.md, "Sheets").
class LinkTest {
 public:
  LinkTest(double object_angle, const SheetOptions& options);
  bool operator()(const MedialSphere& p, const MedialSphere& q) const;

 private:
  double normals_, crease_, salient_;  // cosines
};

/// By position: the number of its component. Numbers ascend from 0 in the order of first voxels.
std::vector<std::uint32_t> grow_components(const VoxelGraph& graph, double object_angle, const SheetOptions& options);

}  // namespace medial_vk
