// A prepared mesh as a solid that answers queries in double precision.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "bvh/wide_tree.h"
#include "medial_vk/bvh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh.h"
#include "mesh/crossings/triangle_tree.h"
#include "mesh/winding/winding_number.h"
#include "mesh/winding_change.h"
#include "solid/closing_surface.h"

namespace medial_vk {

/// Bound of the rounding error of distances computed by `bvh`.
double distance_rounding(const Bvh& bvh);
/// The same for queries in the box of the search (IndexedMesh::on_side()).
double distance_rounding(const IndexedMesh& mesh);

/// The side of the boundary on which all points of a set lie, if it is known that they lie on one.
enum class SolidSide : std::uint8_t { kInside, kOutside, kUnknown };

/// Queries may come from several threads at once.
class Solid {
 public:
  /// Shares the mesh, and refines its tree: small leaves suit scattered queries. Errors: kUsage (the outside of a mesh,
  /// which has no end), kOutOfMemory.
  static Result<Solid> build(const IndexedMesh& mesh);

  const IndexedMesh& indexed() const { return mesh_; }
  const PreparedMesh& mesh() const { return mesh_.prepared(); }
  const Bvh& bvh() const { return bvh_; }
  const WideTree& wide_tree() const { return wide_; }
  /// Nearest point of the boundary within `bound`. Of triangles that are equally near up to rounding, any may be found.
  BvhHit closest(const Point& p, double bound = std::numeric_limits<double>::infinity()) const {
    return wide_.closest(bvh_, p, bound);
  }
  /// The distance to the boundary, within rounding() of the exact one.
  double distance(const Point& p) const;
  double rounding() const { return rounding_; }
  /// True if the winding number is at least 1/2. Both results are possible for points closer to the boundary than
  /// rounding().
  bool contains(const Point& p) const;
  /// True if the boundary may meet the ball.
  bool may_meet(const Point& centre, double radius) const { return distance(centre) <= radius + rounding(); }
  /// The side of all points to which a path leads from `p`, within `radius` of it, that does not meet the boundary.
  /// Known for a closed mesh, and on an open one if the winding number cannot pass 1/2 on such paths (WindingChange).
  /// `radius` is positive.
  SolidSide side_around(const Point& p, double radius) const;
  /// The side of a ball that the boundary does not meet.
  SolidSide side_of_ball(const Point& centre, double radius) const {
    return may_meet(centre, radius) ? SolidSide::kUnknown : side_around(centre, radius);
  }
  /// Of the bounding box.
  double diagonal() const;
  /// True if the mesh bounds the solid and nothing else, so that its signed volume is the solid's. (It is closed, and
  /// no face is known to lie within or outside the solid.)
  bool has_volume() const;
  double volume() const { return mesh().report.signed_volume; }

 private:
  Solid(const IndexedMesh& mesh, Bvh bvh);
  /// The winding number at `p` of the mesh with the triangles that close it, an integer, by rays. No value: each ray
  /// passes an edge, or `p` lies on a triangle.
  std::optional<std::int64_t> whole_number(const Point& p) const;
  /// The winding number of an open mesh at `p`, with an error of at most kDoubt.
  double rough_number(const Point& p, const std::optional<std::int64_t>& whole) const;
  /// The same with an error of at most kSharp.
  double sharp_number(const Point& p, const std::optional<std::int64_t>& whole) const;

  IndexedMesh mesh_;
  Bvh bvh_;
  WideTree wide_;
  double rounding_;
  std::unique_ptr<TriangleTree> triangles_;
  std::unique_ptr<WindingTree> winding_;
  // Null: the mesh has no open edges.
  std::unique_ptr<WindingChange> change_;
  std::unique_ptr<ClosingSurface> closing_;
};

}  // namespace medial_vk
