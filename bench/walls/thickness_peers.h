// What others compute for the thickness at a point or triangle, without a bound, beside which ours is timed.
#pragma once

#include <vector>

#include "medial_vk/indexed_mesh.h"

namespace medial_vk::bench {

/// At each vertex, the diameter of the ball that touches the vertex from inside along its mean normal, shrunk until it
/// holds no point of the boundary (J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest
/// neighbors and the normal field", 2012). One thread.
std::vector<double> shrinking_balls(const IndexedMesh& mesh);

/// For each triangle, CGAL's shape diameter function (25 rays in a cone of 120 degrees, without smoothing); empty
/// without CGAL. One thread.
std::vector<double> shape_diameters(const IndexedMesh& mesh);

}  // namespace medial_vk::bench
