// What requires a bounded solid refuses the outside of a mesh.
#pragma once

#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Error: kUsage, if the solid is the outside (IndexedMesh::on_side()), which has no end.
inline Status check_bounded(const IndexedMesh& mesh) {
  if (mesh.side() == MeshSide::kInside) return {};
  return Error{ErrorCode::kUsage, "the mesh is that of the outside, which has no end: give the mesh itself"};
}

}  // namespace medial_vk
