// The data of a mesh that packet kernels read besides DeviceMesh: a wide tree over the same leaf order, and triangles
// in local frames (shaders/shared/tree/tree_packet.glsl, triangle_frame.glsl).
#pragma once

#include <span>
#include <vector>

#include "device_mesh/device_mesh.h"
#include "device_mesh/device_tree.h"

namespace medial_vk {

constexpr std::uint32_t kTexelsPerWideChild = 2;
constexpr std::uint32_t kTexelsPerFrame = 5;

/// Nodes of `arity` children (at least 2), root first: a binary tree with levels omitted, where the largest box is
/// opened first. Subtrees of at most gpu::kMostLeafTriangles triangles become leaves.
std::vector<Texel> make_wide_tree_texels(std::span<const BvhNode> nodes, const UnitTransform& to_unit,
                                         std::uint32_t arity);

/// Five texels per triangle in leaf order.
std::vector<Texel> make_frame_texels(const MeshView& mesh, std::span<const std::uint32_t> order,
                                     const UnitTransform& to_unit);

class PacketTree {
 public:
  /// Error: kOutOfMemory.
  static Result<PacketTree> create(ContextImpl& context, const DeviceMesh& device, std::uint32_t arity);

  Buffer nodes, frames;
  Buffer positions;  // leaf position by index of the input
  VkBufferView node_texels = VK_NULL_HANDLE, frame_texels = VK_NULL_HANDLE;
  bool use_texels = true;  // false: too large for a view; the views are of a buffer that is never read

 private:
  explicit PacketTree(ContextImpl& context) : arena_(context) {}
  Arena arena_;
};

}  // namespace medial_vk
