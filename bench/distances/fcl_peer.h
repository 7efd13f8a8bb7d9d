// The distance of two meshes by FCL (the Flexible Collision Library), the peer.
#pragma once

#include <memory>

#include "medial_vk/mesh.h"
#include "medial_vk/pose.h"

namespace medial_vk::bench {

class FclPeer {
 public:
  /// Indexes a mesh with FCL's trees of oriented boxes and rectangle swept spheres, its fastest for distances.
  explicit FclPeer(const Mesh& mesh);
  FclPeer(const FclPeer&) = delete;
  FclPeer& operator=(const FclPeer&) = delete;
  ~FclPeer();

  /// False in a build without FCL; distance() may then not be called.
  static bool is_there();
  /// Between the mesh and its copy in a pose, of surfaces: 0 or less where these cross.
  double distance(const Pose& pose) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace medial_vk::bench
