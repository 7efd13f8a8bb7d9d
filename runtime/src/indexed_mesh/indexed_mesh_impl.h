// The data of an IndexedMesh.
#pragma once

#include "base/internals.h"
#include "indexed_mesh/mesh_links.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk {

struct IndexedMesh::Impl {
  PreparedMesh prepared;
  Bvh bvh;
  MeshLinks links;  // by position in bvh.order()
};

}  // namespace medial_vk
