// Copies between the types of the product and those of the CPU reference.
#pragma once

#include "cpu_reference/extract.h"
#include "cpu_reference/mesh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

inline Eigen::Vector3d to_eigen(const Point& p) { return {p[0], p[1], p[2]}; }
reference::Mesh to_reference(const PreparedMesh& mesh);
/// With the box in which medial points are sought, on one side.
reference::Mesh to_reference(const IndexedMesh& mesh);
reference::Options to_reference(const ExtractionOptions& options);
/// Copies grid and spheres only, the input of `--check`.
reference::Result to_reference(const VoxelGrid& grid, const std::vector<MedialSphere>& spheres);

/// Spokes, angle and flux are rounded to float; centre and radius stay double.
Extraction from_reference(const reference::Result& result);

}  // namespace medial_vk
