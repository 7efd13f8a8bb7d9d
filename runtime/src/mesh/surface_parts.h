// The components and patches of a mesh, and a consistent orientation for each patch.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {

struct SurfaceParts {
  std::vector<std::uint32_t> component_of;  ///< By triangle: connected over edges of any kind.
  std::vector<std::uint32_t> patch_of;      ///< By triangle: connected over edges of exactly two triangles.
  std::uint32_t components = 0;
  std::uint32_t patches = 0;
};

SurfaceParts find_parts(const Mesh& mesh, const MeshTopology& topology);

/// Turns over the minority of each patch until neighbours agree, if the patch is orientable; a patch that is not (a
/// Möbius strip) keeps the orientations with fewer disagreeing edges. Returns the number of triangles turned.
std::uint64_t make_patches_consistent(Mesh& mesh, MeshTopology& topology);

/// Turns one triangle over in both structures.
void turn_triangle(Mesh& mesh, MeshTopology& topology, std::uint32_t triangle);

}  // namespace medial_vk
