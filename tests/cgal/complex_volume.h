// Volume and surface of a union of balls from its dual complex, by inclusion and exclusion.
#pragma once

#include <span>

#include "medial_vk/ball_union.h"

namespace medial_vk::test {

struct Measures {
  double volume = 0, area = 0;
};

/// The alternating sum over the complex of what the balls of a simplex have in common (H. Edelsbrunner, "The union of
/// balls and its dual shape", 1995), in the form that leaves what tetrahedra hold to the tetrahedra: each simplex
/// counts with the share of the directions around it that no tetrahedron takes. In 113 bits, so that neither the
/// cancellation of the sum nor spheres that hardly meet matter. `rounded_squares`: the radii are the roots of the
/// squares in double, for which dual_complex_by_cgal() has found the complex; where two centres are as near to each
/// other as rounding, the complex of the one is not that of the other.
Measures measure_by_complex(std::span<const Ball> balls, const DualComplex& complex, bool rounded_squares = false);

}  // namespace medial_vk::test
