// Between the product's types and the CPU reference's own: nothing but copying.
#pragma once

#include "cpu_reference/extract.h"
#include "cpu_reference/mesh.h"
#include "medial_vk/extraction.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

reference::Mesh to_reference(const PreparedMesh& mesh);
reference::Parameters to_reference(const ExtractionOptions& parameters);
/// Grid and spheres only: what `--check` reads.
reference::Result to_reference(const VoxelGrid& grid, const std::vector<MedialSphere>& spheres);

/// Spokes, angle and flux are rounded to float; centre and radius stay double.
Extraction from_reference(const reference::Result& result);

}  // namespace medial_vk
