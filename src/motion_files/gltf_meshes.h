// The meshes of a glTF 2.0 document: triangles, weights of joints, and shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"
#include "motion_files/gltf_accessors.h"

namespace medial_vk {

/// A part of a mesh with one material. All arrays have an element for each vertex.
struct GltfPrimitive {
  GltfArray positions;
  std::vector<Triangle> triangles;  ///< Their corners are vertices.
  std::vector<GltfArray> shapes;    ///< What each shape (morph target) adds to the positions; without values: nothing.
  std::vector<GltfArray> joints;    ///< Four in each set, ...
  std::vector<GltfArray> weights;   ///< ... and their weights.
};

struct GltfMesh {
  std::vector<GltfPrimitive> primitives;  ///< Those with triangles.
  std::uint64_t shapes = 0;
  std::vector<double> weights;  ///< Of the shapes, without an animation.
};

/// Reads a mesh. `values_left` is reduced by values_of() of it. Throws GltfFault; also where that is more.
GltfMesh gltf_mesh_of(const GltfDocument& document, GltfAccessors& accessors, std::uint64_t index,
                      std::uint64_t& values_left);

/// Subtracts from what is left. Throws GltfFault.
void take_values(std::uint64_t values, std::uint64_t& values_left);

/// How many corners and vertices a mesh has, and weights of joints: what each instance of it costs.
std::uint64_t values_of(const GltfMesh& mesh);

/// The weights of the shapes of a mesh as an object declares them: `count` numbers, all 0 if it declares none.
std::vector<double> shape_weights_of(const nlohmann::json& object, std::uint64_t count);

}  // namespace medial_vk
