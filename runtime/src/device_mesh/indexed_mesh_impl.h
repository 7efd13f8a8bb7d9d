// The data of an IndexedMesh.
#pragma once

#include "device/internals.h"
#include "device_mesh/mesh_links.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk {

struct IndexedMesh::Impl {
  PreparedMesh prepared;
  Bvh bvh;
  MeshLinks links;  // by position in bvh.order()
};

}  // namespace medial_vk
