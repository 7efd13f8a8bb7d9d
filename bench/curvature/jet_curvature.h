// Curvature at the vertices of a mesh by CGAL's jet fitting (F. Cazals, M. Pouget, 2005), for comparison.
#pragma once

#include <vector>

#include "mesh_curvature.h"

namespace medial_vk::bench {

/// Whether this program has CGAL (MEDIAL_VK_TEST_CGAL).
bool have_jets();

/// By vertex, from polynomials of degree 4 through the whole rings of neighbours that hold 30 points with the vertex,
/// as in CGAL's example. Empty without CGAL.
std::vector<MeshCurvature> jet_curvature(const Mesh& mesh);

}  // namespace medial_vk::bench
