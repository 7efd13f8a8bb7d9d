// For each node of a tree over triangles, two parallel planes between which its triangles are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

/// A hull that lies along a face of a part meets the boxes of most of its triangles, whatever they are; beyond a plane
/// along the face it meets none of them. Boundaries of parts and of smooth solids are flat in most nodes.
class NodeSlabs {
 public:
  /// Throws std::bad_alloc.
  explicit NodeSlabs(const Bvh& bvh);

  /// True only if no triangle of a node is deeper in a hull than `tolerance`.
  bool beside(std::size_t node, const BallHull& hull, double tolerance) const;

 private:
  struct Slab {
    Point normal;  // of unit length, or zero
    double low, high;
  };
  std::vector<Slab> slabs_;
};

}  // namespace medial_vk
