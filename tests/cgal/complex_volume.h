// The volume of a union of balls, and the area of its envelope, from its dual complex, by inclusion and exclusion.
#pragma once

#include <span>

#include "medial_vk/ball_union.h"

namespace medial_vk::test {

struct Measures {
  double volume = 0, area = 0;
};

/// The alternating sum, over the complex, of the intersections of the balls of each simplex (H. Edelsbrunner, "The
/// union of balls and its dual shape", 1995), in the form in which tetrahedra contribute their own volume: each simplex
/// counts with the share of the directions around it that no tetrahedron takes. Evaluated in 113 bits, so that neither
/// the cancellation of the sum nor spheres that hardly meet matter. `rounded_squares`: the radii are the roots of the
/// squares in double, for which dual_complex_by_cgal() has found the complex; if two centres are as near to each other
/// as rounding, the complexes for radii and for rounded squares differ.
Measures measure_by_complex(std::span<const Ball> balls, const DualComplex& complex, bool rounded_squares = false);

}  // namespace medial_vk::test
