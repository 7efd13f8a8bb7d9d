// A prepared mesh as a solid that answers questions in double precision.
#pragma once

#include <memory>

#include "medial_vk/bvh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"

namespace medial_vk {

/// How far a distance that `bvh` answers may be from the true one, by rounding.
double distance_rounding(const Bvh& bvh);

/// Questions may come from several threads at once.
class Solid {
 public:
  /// Shares the mesh, and refines its tree: small leaves suit scattered queries. Errors: kOutOfMemory.
  static Result<Solid> create(const IndexedMesh& mesh);

  const IndexedMesh& indexed() const { return mesh_; }
  const PreparedMesh& mesh() const { return mesh_.prepared(); }
  const Bvh& bvh() const { return bvh_; }
  /// Nearest point of the boundary.
  BvhHit closest(const Point& p) const { return bvh().closest(p); }
  /// To the boundary, within rounding() of the exact distance.
  double distance(const Point& p) const;
  double rounding() const { return rounding_; }
  /// By the winding number, 1/2 and more being inside; closer to the boundary than rounding() either answer may come.
  bool contains(const Point& p) const;
  /// Of the bounding box.
  double diagonal() const;
  /// Does the mesh bound the solid and nothing else, so that its signed volume is the solid's? (Closed, and no face
  /// lies within or outside it as far as that is known.)
  bool has_volume() const;
  double volume() const { return mesh().report.signed_volume; }

 private:
  Solid(const IndexedMesh& mesh, Bvh bvh);

  IndexedMesh mesh_;
  Bvh bvh_;
  double rounding_;
  std::unique_ptr<TriangleTree> triangles_;
  std::unique_ptr<WindingTree> winding_;
};

}  // namespace medial_vk
