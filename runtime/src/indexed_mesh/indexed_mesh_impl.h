// The data of an IndexedMesh.
#pragma once

#include <optional>

#include "base/internals.h"
#include "indexed_mesh/mesh_links.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk {

struct IndexedMesh::Impl {
  PreparedMesh prepared;
  Bvh bvh;
  MeshLinks links;  // by position in bvh.order()
  MeshSide side = MeshSide::kInside;
  std::optional<double> margin = {};  // of on_side(); 0: half of the longest side

  /// The amount by which the box of the search extends beyond the mesh, at least.
  double room() const;
  /// The further amount by which it does so at its lower corner, along each axis.
  double shift() const;
};

}  // namespace medial_vk
