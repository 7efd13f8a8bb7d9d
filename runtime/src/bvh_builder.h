// Builds the nodes of a Bvh: binned SAH (Wald 2007), parallel over subtrees, the same tree for any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/bvh.h"

namespace medial_vk {

/// A triangle as the builder sees it.
struct BvhPrimitive {
  BvhBox box;
  std::uint32_t triangle = 0;

  double twice_centre(int axis) const { return box.lower[axis] + box.upper[axis]; }
};

class BvhBuilder {
 public:
  /// Reorders `primitives` into leaf order. At least one primitive, leaf_size and threads at least 1.
  BvhBuilder(std::vector<BvhPrimitive>& primitives, std::uint32_t leaf_size, unsigned threads);
  /// Root first, children adjacent, depth at most Bvh::kMaxDepth.
  std::vector<BvhNode> build();

 private:
  struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t count() const { return end - begin; }
  };
  void build_subtree(std::uint32_t node, std::uint32_t room, Range range, std::uint32_t depth, unsigned threads);
  void make_leaf(BvhNode& node, Range range);
  std::uint32_t split(Range range, const BvhBox& centres, std::uint32_t depth);
  std::uint32_t split_at_median(Range range, const BvhBox& centres);
  std::uint32_t levels_of_halving(std::uint32_t count) const;
  std::vector<BvhNode> compact() const;

  std::vector<BvhPrimitive>& primitives_;
  std::vector<BvhNode> sparse_;  // each subtree of n triangles owns room for its 2 n - 2 descendants
  std::uint32_t leaf_size_;
  unsigned threads_;
};

}  // namespace medial_vk
