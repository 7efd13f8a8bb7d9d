// A tree over triangles as kernels of balls that follow a mesh walk it: without a stack.
#pragma once

#include <cstdint>
#include <vector>

#include "follow_types.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

struct ThreadedTree {
  /// Two for each node, in depth-first order (shaders/shared/following/frame.glsl); without boxes.
  std::vector<gpu::uvec4> nodes;
  /// Nodes by their height above the leaves: where heights start in this array, and where the last one ends; then the
  /// nodes.
  std::vector<std::uint32_t> levels;
  std::uint32_t level_count = 0;

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes.size() / 2); }
  std::uint32_t nodes_of(std::uint32_t level) const { return levels[level + 1] - levels[level]; }
};

/// The nodes of `bvh`; triangles are those of its leaf order. Precondition: less than 2^24 of them.
ThreadedTree make_threaded_tree(const Bvh& bvh);

}  // namespace medial_vk
