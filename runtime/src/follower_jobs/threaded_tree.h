// A tree over triangles with eight children a node, as kernels of balls that follow a mesh walk it: eight balls
// together with a node at a time, or one ball box by box, without a stack.
#pragma once

#include <cstdint>
#include <vector>

#include "follow_types.h"
#include "medial_vk/bvh.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

struct ThreadedTree {
  /// The order of the triangles: indices of the mesh, leaf by leaf.
  std::vector<std::uint32_t> order;
  /// Two for each place of a child (shaders/shared/following/frame.glsl), kFollowArity places a node; without boxes,
  /// but those of unused places are empty.
  std::vector<gpu::uvec4> places;
  /// Used places by their height above the leaves: where heights start in this array, and where the last one ends; then
  /// the places.
  std::vector<std::uint32_t> levels;
  std::uint32_t level_count = 0;
  std::uint32_t depth = 0;  // most nodes on a way from the root

  std::uint32_t place_count() const { return static_cast<std::uint32_t>(places.size() / 2); }
  std::uint32_t places_of(std::uint32_t level) const { return levels[level + 1] - levels[level]; }
};

/// From `bvh`, of that mesh, down to its parts of at most 64 triangles; below, one node with full leaves for each part.
/// Precondition: less than 2^24 triangles.
ThreadedTree make_threaded_tree(const MeshView& mesh, const Bvh& bvh);

/// Of the triangles in its order.
std::vector<std::uint32_t> positions_in(const ThreadedTree& tree);

}  // namespace medial_vk
