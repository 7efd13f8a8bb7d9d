#include "medial_vk/mesh_index.h"

#include <utility>

#include "base/host_memory.h"
#include "device_mesh/device_mesh.h"
#include "device_mesh/mesh_links.h"

namespace medial_vk {

Result<MeshIndex> MeshIndex::create(const MeshView& mesh, unsigned threads) {
  // Of a device that takes whatever our kernels do: which one it will be is not known here.
  VkPhysicalDeviceLimits any{};
  any.maxStorageBufferRange = any.maxTexelBufferElements = 0xffffffffu;
  if (Status status = DeviceMesh::check_size(mesh.triangles.size(), any); !status.ok()) return status.error();
  return catch_out_of_memory("indexing a mesh", [&]() -> Result<MeshIndex> {
    Result<Bvh> bvh = Bvh::build(mesh, DeviceMesh::kLeafSize, threads);
    if (!bvh.ok()) return bvh.error();
    MeshIndex index;
    index.bvh_ = std::make_shared<const Bvh>(std::move(bvh).value());
    index.links_ = std::make_shared<const MeshLinks>(make_mesh_links(mesh, index.bvh_->order(), threads));
    index.vertices_ = mesh.vertices.size();
    index.flags_ = mesh.flags.size();
    return index;
  });
}

bool MeshIndex::is_of(const MeshView& mesh) const {
  return bvh_->order().size() == mesh.triangles.size() && vertices_ == mesh.vertices.size() &&
         flags_ == mesh.flags.size();
}

}  // namespace medial_vk
