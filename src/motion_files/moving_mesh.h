// All meshes of a glTF scene as one mesh whose vertices follow nodes: linear blend skinning, with shapes.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "medial_vk/mesh.h"
#include "motion_files/gltf_meshes.h"
#include "motion_files/gltf_nodes.h"
#include "motion_files/mesh_motion.h"

namespace medial_vk {

class MovingMesh {
 public:
  /// What one node shows.
  struct Part {
    std::uint32_t node = 0;
    std::size_t first_vertex = 0, end_vertex = 0;
    std::shared_ptr<const GltfMesh> mesh;
    std::vector<double> weights;  ///< Of its shapes, without an animation.
  };

  /// As read_scene() reads it: a part for each node that shows faces, reflections keep faces outside, and vertices of a
  /// part that coincide at rest are one. Throws GltfFault, also if its instances have more than `most_values` corners,
  /// vertices and influences, and std::bad_alloc.
  MovingMesh(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes, std::uint64_t most_values);

  const Mesh& rest() const { return rest_; }
  const MotionRig& rig() const { return rig_; }
  std::span<const Part> parts() const { return parts_; }
  std::uint64_t separable_vertices() const { return separable_; }
  /// By node, whether a vertex follows it or a node below it.
  std::vector<std::uint8_t> nodes_that_carry(const GltfNodes& nodes) const;

  /// The positions of all vertices where the nodes are at `places`, and the shapes of each part have weights. `joints`
  /// gets the places of the joints.
  void place_vertices(std::span<const AffineMap> places, std::span<const std::vector<double>> weights,
                      std::vector<AffineMap>& joints, std::vector<Point>& positions) const;

 private:
  struct Source {
    std::uint32_t primitive = 0, element = 0;
  };
  class PartBuilder;

  std::uint32_t joint_of_node(const GltfNodes& nodes, std::uint32_t node);
  std::uint32_t first_joint_of_skin(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes,
                                    std::uint64_t skin);
  std::uint32_t add_joint(const GltfNodes& nodes, std::uint64_t group, std::uint64_t node,
                          const AffineMap& inverse_bind);
  void find_parents(const GltfNodes& nodes);

  Mesh rest_;
  MotionRig rig_;
  std::vector<Part> parts_;
  std::vector<Source> sources_;              // by vertex, in the mesh of its part
  std::vector<AffineMap> rest_places_;       // by node
  std::vector<AffineMap> rest_maps_;         // by joint: from the mesh to the scene, at rest
  std::vector<std::uint8_t> is_reflection_;  // by joint, of its map at rest
  std::vector<std::uint64_t> group_of_joint_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint32_t> joint_of_;  // by group and node
  std::map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> skins_;     // the first joint, and their number
  std::uint64_t separable_ = 0;
};

}  // namespace medial_vk
