// The open edges of a mesh, from which the deviation of its winding numbers from whole numbers follows.
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

/// The edges that triangles traverse unequally often in the two directions, with the difference, listed if there are at
/// most `most`. Connected edges share an apex: the triangles between them and their apex, each repeated by the
/// difference, close the mesh.
OpenEdges find_open_edges(const MeshView& mesh, const UnitTransform& to_unit, std::uint32_t most);

}  // namespace medial_vk
