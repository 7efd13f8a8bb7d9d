// What a device is told of a mesh besides its triangles, as far as the host can make it without the device: worth
// making while a device is opened.
#pragma once

#include <memory>

#include "medial_vk/bvh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct MeshLinks;

/// Immutable; copies share what they hold.
class MeshIndex {
 public:
  /// `threads` 0: as many as the machine has. Errors: those of Bvh::build().
  static Result<MeshIndex> create(const MeshView& mesh, unsigned threads = 0);

  /// The tree over the triangles, in the units of the mesh.
  const Bvh& bvh() const { return *bvh_; }

 private:
  friend struct DeviceMesh;
  MeshIndex() = default;

  std::shared_ptr<Bvh> bvh_;  // nobody changes it
  std::shared_ptr<const MeshLinks> links_;
};

}  // namespace medial_vk
