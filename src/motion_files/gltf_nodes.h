// The nodes of a glTF 2.0 document, and their places.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "motion_files/gltf_document.h"
#include "scene_files/affine_map.h"

namespace medial_vk {

/// What an animation can change of a node.
struct NodePose {
  std::array<double, 3> translation = {0, 0, 0};
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< A quaternion, x, y, z, w, of length 1.
  std::array<double, 3> scale = {1, 1, 1};
};

/// First the scale, then the rotation, then the translation.
AffineMap map_of(const NodePose& pose);

struct GltfNode {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::string name;
  std::uint32_t parent = kNone;
  NodePose pose;
  std::optional<AffineMap> matrix;  ///< In the place of a pose.
  std::optional<std::uint64_t> mesh, skin;
};

class GltfNodes {
 public:
  /// Tests that the nodes are trees. Throws GltfFault.
  explicit GltfNodes(const GltfDocument& document);

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const GltfNode& operator[](std::uint64_t node) const;
  /// Parents before their children.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// The nodes of the scene with a mesh: parents first, and children in their order.
  const std::vector<std::uint32_t>& shown() const { return shown_; }

  /// By node, its place in the scene.
  void find_places(const std::vector<NodePose>& poses, std::vector<AffineMap>& places) const;
  std::vector<NodePose> rest_poses() const;

 private:
  void read_nodes(const GltfDocument& document);
  void order_nodes(const GltfDocument& document);
  void find_shown(const GltfDocument& document);

  std::vector<GltfNode> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> shown_;
};

}  // namespace medial_vk
