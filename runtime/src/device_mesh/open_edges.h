// The boundary of an open mesh: what its winding numbers lack to be whole numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "device_mesh/device_tree.h"
#include "gpu_types.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

struct OpenEdges {
  std::uint32_t count = 0;
  std::vector<gpu::OpenEdge> listed;  ///< All of them, in the unit box, or none if there are too many.
};

/// The edges that triangles run along unequally often in the two directions, with what they lack, listed if there are
/// at most `most`. Edges that hang together share an apex: the triangles between them and their apex, as often as is
/// lacking, close the mesh.
OpenEdges find_open_edges(const MeshView& mesh, const UnitTransform& to_unit, std::uint32_t most);

}  // namespace medial_vk
