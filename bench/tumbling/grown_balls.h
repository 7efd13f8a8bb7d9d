// The source's balls for distances: inside balls, grown to the boundary around them.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::bench {

/// S_D+ of S_D (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Section 8.2): every ball reaches, for
/// each vertex of the envelope on its sphere, the boundary point nearest to that vertex. Where two spheres meet and no
/// third one, two opposite points of their circle stand for vertices. Such balls need not be inside, nor cover the
/// solid.
Result<std::vector<Ball>> grown_balls(const IndexedMesh& mesh, std::span<const Ball> balls);

}  // namespace medial_vk::bench
