#include "fcl_peer.h"

#include <cstdlib>

#if defined(MEDIAL_VK_HAVE_FCL)
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <vector>
#endif

namespace medial_vk::bench {

#if defined(MEDIAL_VK_HAVE_FCL)

struct FclPeer::Model {
  fcl::BVHModel<fcl::OBBRSSd> tree;
};

FclPeer::FclPeer(const Mesh& mesh) : model_(std::make_unique<Model>()) {
  std::vector<fcl::Vector3d> vertices;
  for (const Point& p : mesh.vertices) vertices.emplace_back(p[0], p[1], p[2]);
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  model_->tree.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model_->tree.addSubModel(vertices, triangles);
  model_->tree.endModel();
}

bool FclPeer::is_there() { return true; }

double FclPeer::distance(const Pose& pose) const {
  fcl::Transform3d there = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) there.linear()(i, j) = pose.rotation[i][j];
    there.translation()[i] = pose.shift[i];
  }
  const fcl::DistanceRequestd request(false);
  fcl::DistanceResultd result;
  return fcl::distance(&model_->tree, fcl::Transform3d::Identity(), &model_->tree, there, request, result);
}

#else

struct FclPeer::Model {};
FclPeer::FclPeer(const Mesh&) {}
bool FclPeer::is_there() { return false; }
double FclPeer::distance(const Pose&) const { std::abort(); }

#endif

FclPeer::~FclPeer() = default;

}  // namespace medial_vk::bench
