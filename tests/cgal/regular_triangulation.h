// The dual complex by CGAL: its regular triangulation with exact predicates and its own criteria for the simplices in
// it.
#pragma once

#include <span>

#include "medial_vk/ball_union.h"

namespace medial_vk::test {

/// Complete and sorted, like BallUnion::complex. Squared radii are rounded to double; of equal balls, any one counts.
DualComplex dual_complex_by_cgal(std::span<const Ball> balls);

/// Number of vertices of the regular triangulation of the balls, without any further work (for measurements).
std::size_t triangulate_by_cgal(std::span<const Ball> balls);

}  // namespace medial_vk::test
