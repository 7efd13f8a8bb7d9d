// Properties of a mesh derived from its connectivity and shape; nothing is changed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"

namespace medial_vk {

/// Counts edges and vertices by kind and decides whether the mesh is closed. Returns, by vertex, whether its triangles
/// form one closed fan of one orientation.
std::vector<bool> inspect_topology(const Mesh& mesh, const MeshTopology& topology, MeshReport& report);

/// Bounding box of the vertices. Precondition: every vertex belongs to a triangle.
void measure_box(const Mesh& mesh, MeshReport& report);

/// Volumes by the divergence theorem.
struct Volumes {
  double whole = 0;           ///< Signed, about `centre`.
  double parts = 0;           ///< Sum of the absolute volumes of the components.
  double parts_rounding = 0;  ///< Bound of the rounding error of `parts`.
};
Volumes measure_volumes(const Mesh& mesh, const SurfaceParts& parts, const Point& centre);

/// Euler characteristic of the solid that a closed mesh encloses: half that of its boundary, as for every compact set
/// bounded by a surface. No value if the mesh is not closed or not a surface.
std::optional<std::int64_t> euler_characteristic_of_solid(const PreparedMesh& mesh);

/// Full sentences about everything in the report that affects the trust in the result.
void write_assumptions(MeshReport& report);

}  // namespace medial_vk
