// A mesh with more vertices on the same surface, for values that change within large triangles.
#pragma once

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Halves edges longer than `longest_edge`, in mesh units and positive, and cuts their triangles, until none is left.
/// The vertices of the mesh come first. An edge is halved for all its triangles at once, so that no crack appears; new
/// vertices lie on the surface but for the rounding of their coordinates.
Mesh refine_mesh(const Mesh& mesh, double longest_edge);

}  // namespace medial_vk
