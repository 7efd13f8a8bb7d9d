// The boundary of an open mesh: what its winding numbers lack to be whole numbers.
#pragma once

#include <vector>

#include "device_tree.h"
#include "gpu_types.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The edges that triangles run along unequally often in the two directions, with what they lack, in the unit box.
/// Edges that hang together share an apex: the triangles between them and their apex, as often as `lack` says, close
/// the mesh. Empty if every edge is run along as often in one direction as in the other.
std::vector<gpu::OpenEdge> make_open_edges(const MeshView& mesh, const UnitTransform& to_unit);

}  // namespace medial_vk
