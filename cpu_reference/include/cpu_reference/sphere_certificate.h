// Do balls lie inside a solid? Do they cover it? Recomputed from the numbers as written, plainly.
#pragma once

#include <vector>

#include "cpu_reference/ball_union.h"
#include "cpu_reference/certificate.h"
#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

/// Of every ball: finite numbers, centre inside, radius at most the exact distance (rounded down).
Certificate check_inside(const Mesh& mesh, const std::vector<UnionBall>& balls);

/// Of every triangle: it can be cut into pieces each of which lies in one ball. Of every point that three spheres have
/// in common and that no ball holds: it is outside the solid. With a closed mesh both together say that the balls cover
/// the solid (docs/theory.md, "Tight spheres"); of an open one, that they cover its surface: one more row says so.
Certificate check_cover(const Mesh& mesh, const std::vector<UnionBall>& balls);

}  // namespace medial_vk::reference
