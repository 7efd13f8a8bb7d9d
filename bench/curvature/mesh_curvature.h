// Curvature at the vertices of a mesh (S. Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle
// Meshes", 2004), for comparison.
#pragma once

#include <array>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

struct MeshCurvature {
  Point normal = {0, 0, 0};
  std::array<double, 2> kappa = {0, 0};  ///< The greater one first, positive where convex.
  std::array<Point, 2> directions = {};
};

/// By vertex. The form of a face is the one of least squares for the turn of the vertex normals along its sides; that
/// of a vertex is the mean of its faces, with the areas of its Voronoi cell as weights.
std::vector<MeshCurvature> mesh_curvature(const Mesh& mesh);

}  // namespace medial_vk::bench
