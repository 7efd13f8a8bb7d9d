#pragma once

#include <cstdint>
#include <memory>

#include "medial_vk/bvh.h"
#include "medial_vk/mesh.h"
#include "mesh/crossings/triangle_tree.h"
#include "mesh/mesh_topology.h"
#include "mesh/winding/winding_number.h"

namespace medial_vk {

/// Triangles that close an open mesh: each open edge is joined to one point of its hole. The winding number of the mesh
/// is an integer, that of both together, less that of these triangles, which are few (docs/theory.md, "Outside").
class ClosingSurface {
 public:
  ClosingSurface(const ClosingSurface&) = delete;  // winding_ refers to tree_
  ClosingSurface& operator=(const ClosingSurface&) = delete;

  /// Null: the mesh has no open edges. Errors: kOutOfMemory.
  static Result<std::unique_ptr<ClosingSurface>> build(const Mesh& mesh, const MeshTopology& topology);

  /// Triangles, each as often as its edge is open.
  std::size_t size() const { return mesh_.triangles.size(); }
  const Bvh& bvh() const { return bvh_; }

  /// With the error of WindingTree.
  double rough_number(const Point& p) const { return winding_.at(p); }
  /// Up to rounding.
  double number(const Point& p) const { return exact_winding_number(mesh_, p); }

 private:
  ClosingSurface(Mesh mesh, Bvh bvh);

  Mesh mesh_;
  Bvh bvh_;
  TriangleTree tree_;
  WindingTree winding_;
};

}  // namespace medial_vk
