// A bounding volume hierarchy over triangles, built on the CPU by binned SAH (Wald 2007), in double precision, and
// refitted when they move. It is what is uploaded to the device, and it answers exact queries on the host.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// An axis-aligned box in the units of the mesh, rounded outwards.
struct BvhBox {
  Point lower;
  Point upper;
};

/// Inner node: children are `first` and `first + 1`, count is 0. Leaf: triangles order[first .. first + count).
struct BvhNode {
  BvhBox box;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct BvhHit {
  double squared_distance = std::numeric_limits<double>::infinity();
  Point point = {0, 0, 0};
  std::uint32_t triangle = 0xffffffffu;  ///< Index into the mesh's triangles.
};

class Bvh {
 public:
  /// No leaf lies deeper below the root; what a traversal stack must hold.
  static constexpr std::uint32_t kMaxDepth = 48;

  /// Copies the corners of the triangles in leaf order. `threads` 0: as many as the machine has.
  /// Errors: kInvalidMesh (no triangle, index out of range, coordinate not finite), kOutOfMemory.
  static Result<Bvh> build(const MeshView& mesh, std::uint32_t leaf_size = 4, unsigned threads = 0);

  /// The same tree with its leaves split further, for scattered queries on the host: what build() makes of the same
  /// triangles for `leaf_size`, if none has moved since, without sorting them again. Errors: kOutOfMemory.
  Result<Bvh> refined(std::uint32_t leaf_size) const;

  /// Follows triangles that have moved: takes their corners from `mesh` and makes every box the least one around the
  /// triangles below it; which triangles that are, and the order of the leaves, stays. Triangle t of `mesh` takes the
  /// place of triangle t. All answers are as right as those of a new tree, and nearly as quick while triangles that
  /// were neighbours stay neighbours. Time linear in the triangles, `threads` as in build(), which does not show in
  /// the result. Errors: kInvalidMesh (another number of triangles, index out of range, coordinate not finite: the
  /// tree is as it was), kOutOfMemory (it is of no use until a refit succeeds).
  Status refit(const MeshView& mesh, unsigned threads = 0);

  const std::vector<BvhNode>& nodes() const { return nodes_; }                   ///< Root first.
  const std::vector<std::uint32_t>& order() const { return order_; }             ///< Triangle index by leaf position.
  const std::vector<std::array<Point, 3>>& corners() const { return corners_; }  ///< By leaf position.

  /// Nearest point of the mesh to p closer than `bound` (not squared), or triangle = 0xffffffff if there is none.
  BvhHit closest(const Point& p, double bound = std::numeric_limits<double>::infinity()) const;
  /// For several closest points near one another: leaf positions of all triangles within `radius` of `centre`, and of
  /// some that are a little farther away, replace `positions`; closest_of() and find_within() then test no others.
  void gather_within(const Point& centre, double radius, std::vector<std::uint32_t>& positions) const;
  /// The leaves, as indices into nodes(), whose boxes reach within `radius` of `centre` replace `leaves`.
  void gather_leaves(const Point& centre, double radius, std::vector<std::uint32_t>& leaves) const;
  /// As closest(), among the triangles at these leaf positions and `best`, what is known of others.
  BvhHit closest_of(const Point& p, std::span<const std::uint32_t> positions, BvhHit best = {}) const;
  /// Index in `positions` of the first of these triangles that is closer to p than `radius` (positive), or their
  /// number.
  std::size_t find_within(const Point& p, double radius, const std::vector<std::uint32_t>& positions) const;
  /// Is there a point of the mesh at a distance below `radius` from `centre`? Stops at the first.
  bool any_within(const Point& centre, double radius) const;

 private:
  void take_corners(const MeshView& mesh, unsigned threads);
  /// Makes the triangle at a leaf position the best if it is nearer, or as near and of a smaller index.
  void improve(const Point& p, std::uint32_t position, BvhHit& best) const;

  std::vector<BvhNode> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::array<Point, 3>> corners_;
};

}  // namespace medial_vk
