// Hulls of a search made free of the boundary to the last bit, and how far the boundary is from them.
#pragma once

#include <span>
#include <vector>

#include "hull_fits/proof/hull_prover.h"
#include "medial_vk/ball_hull.h"
#include "medial_vk/sphere_measures.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// Hulls that are proved to lie inside, and by how much the radii of one had to give way at most, in mesh units.
struct FreedHulls {
  std::vector<BallHull> hulls;
  double greatest_shrink = 0;
};

/// The same hulls, with all radii of each smaller by the least for which planes separate it from every triangle: the
/// depth of triangles that the linear program of the search leaves, and rounding. Beside an opening of the boundary,
/// which no triangle limits, radii give way until the side is known; a hull for which that fails is left out. Throws
/// Stopped at a stop by `threads`.
FreedHulls free_hulls(const Solid& solid, std::span<const BallHull> hulls, const Threads& threads);

/// Bounds of the greatest distance from a point of the boundary to the hulls, at least one, in mesh units, 0 in them:
/// by branch and bound, to hull_gap_width() unless that takes too many parts of triangles. Throws Stopped.
Bounds measure_hull_gap(const Solid& solid, std::span<const BallHull> hulls, double goal, const Threads& threads);
/// The difference of these bounds: a thousandth of the diagonal, or less if a `goal` above 0 needs it, and rounding.
double hull_gap_width(const Solid& solid, double goal);

}  // namespace medial_vk
