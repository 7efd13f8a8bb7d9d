#include "medial_vk/mesh_index.h"

#include <utility>

#include "host_memory.h"
#include "mesh_links.h"
#include "scene.h"

namespace medial_vk {

Result<MeshIndex> MeshIndex::create(const MeshView& mesh, unsigned threads) {
  return catch_out_of_memory("indexing a mesh", [&]() -> Result<MeshIndex> {
    Result<Bvh> bvh = Bvh::build(mesh, DeviceMesh::kLeafSize, threads);
    if (!bvh.ok()) return bvh.error();
    MeshIndex index;
    index.bvh_ = std::make_shared<Bvh>(std::move(bvh).value());
    index.links_ = std::make_shared<const MeshLinks>(make_mesh_links(mesh, index.bvh_->order(), threads));
    return index;
  });
}

}  // namespace medial_vk
