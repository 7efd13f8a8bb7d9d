// A mesh with its index, which extraction, certificate, queries, recorded jobs and fits of spheres share.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/bvh.h"
#include "medial_vk/mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct IndexOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The index does not depend on it.
};

struct MoveOptions {
  /// TriangleFlags for the new positions, for which the caller is responsible; empty: the present flags are kept.
  std::span<const std::uint8_t> flags = {};
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// Where medial points are sought: on one side of the boundary, within a box.
struct SideOptions {
  MeshSide side = MeshSide::kOutside;
  /// In the units of the mesh: the box reaches this far beyond its bounding box on all sides (0: half of its longest
  /// side L; at most 10 L), and 0.0144 L further at its lower corner, so that simple planes lie in no face of voxels.
  double margin = 0;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// A prepared mesh, the tree over its triangles, and the links between triangles at edges and vertices. It is built
/// once, on the host and without a device, and is the input of every step. Copies share their data; move_vertices() on
/// one copy does not change the others.
class IndexedMesh {
 public:
  /// Errors: kInvalidMesh (no triangle, an index out of range, a coordinate that is not finite, flags that are neither
  /// none nor one per triangle), kOutOfMemory.
  static Result<IndexedMesh> build(PreparedMesh mesh, const IndexOptions& options = {});
  /// Builds the index of a mesh that is known to be clean, such as that of a renderer, without its preparation. Arrays
  /// are copied, the caller is responsible for the flags, and the report holds only the counts and the box. The same
  /// errors.
  static Result<IndexedMesh> build(const MeshView& mesh, const IndexOptions& options = {});

  /// The same boundary for the search on one side of it, within a box around it. Of the outside, the triangles are
  /// turned over: the solid of the result is all of space but what the mesh encloses, and its cavities belong to it.
  /// Of an open mesh it is where the winding number is at most 1/2, and no normal is trusted: triangles lose the flag
  /// kTrustedNormal. The box bounds the centres of medial spheres only: it is no wall, and spheres may reach beyond it.
  /// The vertices and the order of the triangles stay as they are, and so does the report, which is that of the mesh.
  /// Extractions, certify_spheres(), analyse(), jobs and queries of triangles take the result; calls that require a
  /// bounded solid, such as fits of spheres, give the error kUsage for the outside. Precondition: this is not the
  /// outside itself (the error kUsage). Errors: kUsage (a margin out of range), kOutOfMemory.
  Result<IndexedMesh> on_side(const SideOptions& options) const;
  /// The side on which an extraction seeks medial points: kInside unless on_side() has chosen the other.
  MeshSide side() const;
  /// The corners of the box in which they lie: the bounding box, or that of on_side().
  Point region_lower() const;
  Point region_upper() const;
  /// The margin of that box (SideOptions::margin), 0 for the bounding box.
  double margin() const;

  // A move is a copy, so that no object is ever empty.
  IndexedMesh(const IndexedMesh&) = default;
  IndexedMesh& operator=(const IndexedMesh&) = default;
  ~IndexedMesh() = default;

  /// The mesh, its flags and its report. After move_vertices() the box in the report is that of the moved mesh; the
  /// rest of the report is unchanged.
  const PreparedMesh& prepared() const;
  MeshView view() const;
  /// True if both share their data. Two meshes that were built separately are different, even if they are equal.
  bool is_same(const IndexedMesh& other) const { return impl_ == other.impl_; }
  /// The tree over the triangles, in the units of the mesh.
  const Bvh& bvh() const;
  /// Longest side of the bounding box, or of the box of on_side(): the unit of every fraction in ExtractionOptions.
  double longest_side() const;

  /// Follows vertices that have moved; their number is unchanged. The tree is refitted: results are as exact as those
  /// of a new tree, and nearly as fast while neighbours stay neighbours. Errors: kInvalidMesh (another number of
  /// vertices or flags, a coordinate that is not finite: the mesh is unchanged), kOutOfMemory (likewise). The box of
  /// on_side() follows the bounding box, and outside of an open mesh kTrustedNormal is dropped from the flags.
  Status move_vertices(std::span<const Point> vertices, const MoveOptions& options = {});

 private:
  friend struct Internals;
  struct Impl;
  explicit IndexedMesh(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

}  // namespace medial_vk
