// What a device is told of a mesh besides its triangles, as far as the host can make it without the device: worth
// making while a device is opened.
#pragma once

#include <cstddef>
#include <memory>

#include "medial_vk/bvh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct MeshLinks;

/// Of one mesh as it is: not after its vertices, triangles or flags have changed. Immutable; copies share what they
/// hold.
class MeshIndex {
 public:
  /// `threads` 0: as many as the machine has. Errors: those of Bvh::build(); kOutOfMemory also for a mesh of more
  /// triangles than any device is asked to take.
  static Result<MeshIndex> create(const MeshView& mesh, unsigned threads = 0);

  // Moving is copying: none is ever empty.
  MeshIndex(const MeshIndex&) = default;
  MeshIndex& operator=(const MeshIndex&) = default;
  ~MeshIndex() = default;

  /// The tree over the triangles, in the units of the mesh.
  const Bvh& bvh() const { return *bvh_; }
  /// As far as the numbers of triangles, vertices and flags tell.
  bool is_of(const MeshView& mesh) const;

 private:
  friend struct DeviceMesh;
  MeshIndex() = default;

  std::shared_ptr<const Bvh> bvh_;
  std::shared_ptr<const MeshLinks> links_;
  std::size_t vertices_ = 0, flags_ = 0;
};

}  // namespace medial_vk
