// A bounding volume hierarchy over triangles, built on the CPU by binned SAH (Wald 2007), in double precision, and
// refitted when they move. It is uploaded to the device, and answers exact queries on the host.
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

/// The nearest point of a mesh to a query point.
struct BvhHit {
  double squared_distance = std::numeric_limits<double>::infinity();
  Point point = {0, 0, 0};
  std::uint32_t triangle = 0xffffffffu;  ///< Index into the mesh's triangles; the smallest among exact ties.
};

struct BvhOptions {
  std::uint32_t leaf_size = 4;  ///< Most triangles of a leaf; a leaf at the greatest depth may have more.
  unsigned threads = 0;         ///< Of the host, 0: one per core. The tree does not depend on it.
};

struct RefitOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// The tree. Queries may come from several threads at once.
class Bvh {
 public:
  /// Greatest depth of a leaf below the root, and so the capacity that a traversal stack requires.
  static constexpr std::uint32_t kMaxDepth = 48;

  /// Copies the corners of the triangles in leaf order. Errors: kInvalidMesh (no triangle, index out of range,
  /// coordinate not finite), kOutOfMemory.
  static Result<Bvh> build(const MeshView& mesh, const BvhOptions& options = {});

  /// Follows triangles that have moved: takes the corners of triangle t from triangle t of `mesh`, and makes every box
  /// the least one around the triangles below it. The triangles of each node and the order of the leaves stay the same.
  /// All answers are as exact as those of a new tree, and nearly as fast while triangles that were neighbours stay
  /// neighbours. The time is linear in the number of triangles. Errors: kInvalidMesh (another number of triangles,
  /// index out of range, coordinate not finite: the tree is unchanged), kOutOfMemory (the tree is unusable until a
  /// refit succeeds).
  Status refit(const MeshView& mesh, const RefitOptions& options = {});

  const std::vector<BvhNode>& nodes() const { return nodes_; }                   ///< Root first.
  const std::vector<std::uint32_t>& order() const { return order_; }             ///< Triangle index by leaf position.
  const std::vector<std::array<Point, 3>>& corners() const { return corners_; }  ///< By leaf position.

  /// The nearest point of the mesh to p. If no point is closer than `bound` (a distance, not its square), `triangle` is
  /// 0xffffffff.
  BvhHit closest(const Point& p, double bound = std::numeric_limits<double>::infinity()) const;
  /// True if a point of the mesh lies at a distance below `radius` from `centre`. Stops at the first.
  bool any_within(const Point& centre, double radius) const;

 private:
  friend struct Internals;
  Result<Bvh> refined(std::uint32_t leaf_size) const;
  void take_corners(const MeshView& mesh, unsigned threads);

  std::vector<BvhNode> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::array<Point, 3>> corners_;
};

}  // namespace medial_vk
