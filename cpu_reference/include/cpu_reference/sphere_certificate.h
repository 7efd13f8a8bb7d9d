// Tests that balls lie inside a solid, or that they cover it, from the numbers as written and by simple methods.
#pragma once

#include <vector>

#include "cpu_reference/ball_union.h"
#include "cpu_reference/certificate.h"
#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

/// Tests that every ball has finite numbers, its centre inside the solid, and a radius of at most the exact distance
/// (rounded down).
Certificate check_inside(const Mesh& mesh, const std::vector<UnionBall>& balls);

/// Tests that every triangle can be cut into parts each of which lies in one ball, and that every common point of three
/// spheres that lies in no ball is outside the solid. For a closed mesh both together prove that the balls cover the
/// solid (docs/theory.md, "Tight spheres"); for an open one, that they cover its surface, as an additional row states.
Certificate check_cover(const Mesh& mesh, const std::vector<UnionBall>& balls);

}  // namespace medial_vk::reference
