// Tests that convex hulls of balls lie inside a solid, from the numbers as written and by simple methods: balls of
// random weights, and the least distance along edges. There are no separating planes, which the proof of the product
// uses.
#pragma once

#include <functional>
#include <vector>

#include "cpu_reference/ball_union.h"
#include "cpu_reference/certificate.h"
#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

/// The hull of one to three balls is the union of the balls B(c, r) with c and r linear over the simplex of the
/// centres.
struct Hull {
  std::vector<UnionBall> balls;
};

/// Tests that every hull has one to three balls with finite numbers and centres inside the solid, that balls of random
/// weights have their centre inside and a radius of at most the exact distance, and that along every edge of the axis
/// the radius is nowhere greater than the distance to any triangle. Allowed is what rounding moves the tested balls by.
/// `seen(i)` is called before hull i.
Certificate check_hulls(const Mesh& mesh, const std::vector<Hull>& hulls, const std::function<void(std::size_t)>& seen);

}  // namespace medial_vk::reference
