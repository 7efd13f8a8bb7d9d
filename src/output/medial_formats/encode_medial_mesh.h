// The medial mesh as a file: PLY, or the .ma of Q-MAT (Li et al. 2015).
#pragma once

#include <span>
#include <string>

#include "medial_vk/medial_mesh.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk {

/// Points with radius, sheet and marks; triangles; edges with their marks. The sheet of a triangle follows from its
/// corners: some readers of binary PLY (meshio 5) accept only lists in faces.
std::string encode_medial_mesh_ply(const MedialHeader& header, std::span<const MedialSphere> spheres,
                                   const Sheets& sheets, const MedialMesh& mesh, bool ascii);
/// Numbers have the fewest digits that read back exactly. The format has no sheets and no marks.
std::string encode_medial_mesh_ma(std::span<const MedialSphere> spheres, const MedialMesh& mesh);

/// Chooses the format by the extension of `path`; PLY for standard output.
std::string encode_medial_mesh(const std::string& path, const MedialHeader& header,
                               std::span<const MedialSphere> spheres, const Sheets& sheets, const MedialMesh& mesh,
                               bool ascii);

}  // namespace medial_vk
